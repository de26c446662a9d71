#include "engine/service/resident/cancel_line.h"

#include <fmt/format.h>

#include <limits>

#include "engine/service/resident/connect_host.h"

namespace footwall::service {
namespace {

constexpr int kCancel = 2;  // a message's tag
constexpr std::chrono::milliseconds kPause(5);
// The leader leaves in order.
constexpr std::uint64_t kGoodbye = std::numeric_limits<std::uint64_t>::max();

}  // namespace

CancelLine::CancelLine(const comm::Communicator& world, const std::filesystem::path& folder,
                       const std::vector<int>& host_of, std::function<void()> left_alone)
    : world_(world.get()), hosts_(host_of, world.rank()), left_alone_(std::move(left_alone)) {
  connect_host(world_, hosts_, folder / fmt::format("cancel-{}", hosts_.leader), leader_, member_);
  world_.collectively([&] {
    if (world_.rank() == 0) {
      thread_ = std::thread([this] { watch_call(); });
    } else if (!hosts_.is_leader) {
      thread_ = std::thread([this] { listen(); });
    }
  });
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
    leader_->send(command);
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
    // Where there are other hosts, the main thread has to tell them, and would not once its own context was
    // cancelled.
    if (asked_->cancelled() && hosts_.other_leaders.empty()) {
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
    cancel_mine(*word);
  }
  {
    const std::scoped_lock lock(mutex_);
    if (ended_) return;
  }
  left_alone_();
}

void CancelLine::look() {
  if (world_.rank() == 0) {
    if (hosts_.other_leaders.empty() || !asked_ || !asked_->cancelled() || told_ == command_) return;
    told_ = command_;
    for (const int leader : hosts_.other_leaders)
      comm::check(MPI_Send(&told_, 1, MPI_UINT64_T, leader, kCancel, world_.get()), "MPI_Send");
    pass_on(told_);
    return;
  }
  if (!hosts_.is_leader) return;
  for (;;) {
    int there = 0;
    comm::check(MPI_Iprobe(0, kCancel, world_.get(), &there, MPI_STATUS_IGNORE), "MPI_Iprobe");
    if (there == 0) return;
    std::uint64_t command = 0;
    comm::check(MPI_Recv(&command, 1, MPI_UINT64_T, 0, kCancel, world_.get(), MPI_STATUS_IGNORE), "MPI_Recv");
    pass_on(command);
  }
}

}  // namespace footwall::service
