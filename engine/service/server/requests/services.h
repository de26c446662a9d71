// What requests need of the engine. Shared: a call may live longer than the server that took it.
#pragma once
#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <string>

#include "engine/service/queue/call_queue.h"
#include "engine/service/resident_status.h"

namespace footwall::service {

// Ids of jobs that run beside the ranks' own.
inline constexpr std::uint64_t kPillarJobs = 1'000'000'000;

struct Services {
  Services(CallQueue& ranks_queue, std::function<ResidentStatus()> ask_status,
           std::function<void()> end_engine)
      : queue(ranks_queue), status(std::move(ask_status)), shutdown(std::move(end_engine)) {}

  CallQueue& queue;
  CallQueue pillars{16, kPillarJobs};  // for this process alone: no rank takes part
  std::function<ResidentStatus()> status;
  std::function<void()> shutdown;  // called once
  std::atomic<bool> told_to_end{false};
  std::filesystem::path scratch;
  std::string version;
  std::chrono::steady_clock::time_point since = std::chrono::steady_clock::now();
  // Bytes of messages that wait for their turn, of all clients.
  std::atomic<std::int64_t> waiting_bytes{0};
};

}  // namespace footwall::service
