// How a cancel of the running command reaches all ranks while they compute or wait in MPI, in milliseconds: a
// small thread of every rank waits for it, without MPI, and those of leaders pass it on to their host.
#pragma once
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/service/resident/host_line.h"
#include "storage/base/job_context.h"

namespace footwall::service {

class CancelLine {
 public:
  // left_alone: called by the thread, once, where the rank that leads this one has died (its host's leader,
  // or rank 0): it may be in the middle of a communication that never ends. Collective; throws on all ranks
  // or on none.
  CancelLine(const comm::Communicator& world, const std::filesystem::path& folder,
             const std::vector<int>& host_of, std::function<void()> left_alone);
  ~CancelLine();
  CancelLine(const CancelLine&) = delete;
  CancelLine& operator=(const CancelLine&) = delete;

  // The next command begins, which all ranks count; `mine` is this rank's context. On rank 0, `asked` is the
  // one that others cancel.
  void begin(const JobContext& mine, const std::optional<JobContext>& asked = std::nullopt);
  // It ended, or failed, on this rank.
  void end();

 private:
  void watch_call();  // rank 0's thread
  void listen();      // the others'
  void cancel_mine(std::uint64_t command);
  void pass_on(std::uint64_t command);

  std::optional<HostLineLeader> leader_;
  std::optional<HostLineMember> member_;
  std::function<void()> left_alone_;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t command_ = 0;    // the running one, or the last
  std::uint64_t cancelled_ = 0;  // the newest that was cancelled; perhaps one that this rank has yet to begin
  std::optional<JobContext> mine_;
  std::optional<JobContext> asked_;
  bool asleep_ = false;
  bool ended_ = false;
  std::thread thread_;
};

}  // namespace footwall::service
