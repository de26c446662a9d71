#include "engine/service/resident/cancel_line.h"

#include <fmt/format.h>

#include <limits>

#include "engine/service/resident/connect_ranks.h"

namespace footwall::service {
namespace {

constexpr std::chrono::milliseconds kPause(5);
// The leader leaves in order.
constexpr std::uint64_t kGoodbye = std::numeric_limits<std::uint64_t>::max();

}  // namespace

CancelLine::CancelLine(const comm::Communicator& world, const std::filesystem::path& folder,
                       const std::vector<int>& host_of, std::function<void()> left_alone)
    : left_alone_(std::move(left_alone)) {
  const Hosts hosts(host_of, world.rank());
  connect_ranks(world, hosts, folder / fmt::format("cancel-{}", hosts.leader), leader_, member_);
  world.collectively(
      [&] { thread_ = member_ ? std::thread([this] { listen(); }) : std::thread([this] { watch_call(); }); });
}

CancelLine::~CancelLine() {
  {
    const std::scoped_lock lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
  if (member_) member_->hang_up();
  if (thread_.joinable()) thread_.join();
  try {
    if (leader_) leader_->send(kGoodbye);
  } catch (const Error&) {
    // A member has left before: it needs no goodbye. Others that get none end, as they should.
  }
}

void CancelLine::begin(const JobContext& mine, const std::optional<JobContext>& asked) {
  const std::scoped_lock lock(mutex_);
  ++command_;
  mine_ = mine;
  asked_ = asked;
  if (cancelled_ == command_) mine.cancel();
  if (asleep_) changed_.notify_all();
}

void CancelLine::end() {
  const std::scoped_lock lock(mutex_);
  mine_.reset();
  asked_.reset();
}

void CancelLine::cancel_mine(std::uint64_t command) {
  const std::scoped_lock lock(mutex_);
  cancelled_ = std::max(cancelled_, command);
  if (mine_ && cancelled_ == command_) mine_->cancel();
}

void CancelLine::pass_on(std::uint64_t command) {
  try {
    if (leader_) leader_->send(command);
  } catch (const Error&) {
    // A rank has gone: the launcher ends the others.
  }
  cancel_mine(command);
}

void CancelLine::watch_call() {
  std::unique_lock lock(mutex_);
  while (!ended_) {
    if (!asked_ || cancelled_ == command_) {
      asleep_ = true;
      changed_.wait(lock);
      asleep_ = false;
      continue;
    }
    if (asked_->cancelled()) {
      const std::uint64_t command = command_;
      lock.unlock();
      pass_on(command);
      lock.lock();
      continue;
    }
    changed_.wait_for(lock, kPause);
  }
}

void CancelLine::listen() {
  while (const auto word = member_->receive()) {
    if (*word == kGoodbye) return;
    pass_on(*word);
  }
  {
    const std::scoped_lock lock(mutex_);
    if (ended_) return;
  }
  left_alone_();
}

}  // namespace footwall::service
