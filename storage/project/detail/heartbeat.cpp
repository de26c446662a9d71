#include "storage/project/detail/heartbeat.h"

#include <sys/stat.h>

#include <fmt/format.h>
#include <chrono>
#include <utility>

#include "storage/base/log.h"
#include "storage/project/detail/writer_lock.h"

namespace footwall::project::detail {

Heartbeat::Heartbeat(int file, std::string what)
    : file_(file), what_(std::move(what)), thread_([this] { beat(); }) {}

Heartbeat::~Heartbeat() {
  {
    const std::lock_guard guard(mutex_);
    ended_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void Heartbeat::beat() {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, std::chrono::seconds(kLeaseRenewSeconds), [this] { return ended_; })) {
    if (::futimens(file_, nullptr) != 0) log::warn(fmt::format("cannot renew {}", what_));
  }
}

}  // namespace footwall::project::detail
