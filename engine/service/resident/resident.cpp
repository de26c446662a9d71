#include "engine/service/resident/resident.h"

#include <fmt/format.h>
#include <time.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <mutex>
#include <thread>

#include "engine/service/ranks.pb.h"
#include "engine/service/resident/cancel_line.h"
#include "engine/service/resident/commands.h"
#include "engine/service/resident/doorbell.h"
#include "engine/service/resident/hosts.h"
#include "engine/service/resident/resident_state.h"
#include "storage/base/log.h"

namespace footwall::service {
namespace {

constexpr std::size_t kMostNameBytes = 256;

std::int64_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::int64_t whole = 0;
  std::int64_t resident = 0;
  file >> whole >> resident;
  return file ? resident * sysconf(_SC_PAGESIZE) : 0;
}

// Nanoseconds that all processes of a host count alike.
std::uint64_t host_clock() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000 + static_cast<std::uint64_t>(now.tv_nsec);
}

const CommandRow* row_of(const v1::Command& command) {
  for (const CommandRow& row : command_rows()) {
    if (row.kind == static_cast<int>(command.what_case())) return &row;
  }
  return nullptr;
}

comm::Bytes bytes_of(const v1::Command& command) {
  comm::Bytes bytes(command.ByteSizeLong());
  if (!command.SerializeToArray(bytes.data(), static_cast<int>(bytes.size())))
    throw Error(ErrorCode::kMemory, "a request is too large to be passed on", "ask in smaller pieces");
  return bytes;
}

// The launcher ends with its first rank; so do ranks that it cannot reach.
void leave_alone() {
  log::error("the rank that leads this one has died: this one ends, too");
  std::_Exit(EXIT_FAILURE);
}

}  // namespace

struct Resident::State {
  State(comm::Communicator& its_world, const ResidentOptions& options, const std::vector<int>& host_of)
      : world(its_world),
        doorbell(world, options.folder, host_of),
        cancels(world, options.folder, host_of, options.left_alone ? options.left_alone : leave_alone),
        resident(world, options.threads, options.volumes, host_of, options.memory_bytes) {}

  std::optional<Error> run(const v1::Command& command, const Send& send, const JobContext& job);
  void settle();
  void gather_ranks();

  // Rank 0.
  void dispatch(CallQueue& queue);
  void carry_out(Call& call, CallQueue& queue);
  void carry_out_together(const v1::Command& command, Call& call, CallQueue& queue);
  void read(Call& call, const v1::Command& command);
  void read_between(CallQueue& queue);
  void stop_others();
  // The others.
  void follow();

  comm::Communicator& world;
  std::uint64_t begun_at = 0;  // host_clock() of the running command: rung, or heard
  Doorbell doorbell;
  CancelLine cancels;
  ResidentState resident;
  std::thread::id main = std::this_thread::get_id();
  mutable std::mutex mutex;  // of status
  ResidentStatus status;
};

Resident::Resident(comm::Communicator& world, const ResidentOptions& options) {
  const std::vector<int> host_of = options.host_of.empty() ? host_of_ranks(world) : options.host_of;
  state_ = std::make_unique<State>(world, options, host_of);
  state_->status.threads = options.threads;
  state_->gather_ranks();
  state_->settle();
}

Resident::~Resident() = default;

ResidentStatus Resident::status() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->status;
}

void Resident::serve(CallQueue* queue) {
  State& s = *state_;
  require((queue != nullptr) == (s.world.rank() == 0), "a queue on rank 0 alone");
  if (queue == nullptr) {
    s.follow();
    return;
  }
  s.dispatch(*queue);
  s.stop_others();
}

void Resident::State::gather_ranks() {
  struct Facts {
    std::array<char, kMostNameBytes> host{};
    std::int64_t process = 0;
  };
  Facts mine;
  gethostname(mine.host.data(), mine.host.size() - 1);
  mine.process = getpid();
  std::vector<Facts> all(static_cast<std::size_t>(world.size()));
  comm::check(MPI_Gather(&mine, sizeof mine, MPI_BYTE, all.data(), sizeof mine, MPI_BYTE, 0, world.get()),
              "MPI_Gather");
  if (world.rank() != 0) return;
  for (const Facts& each : all) status.ranks.push_back({each.host.data(), static_cast<int>(each.process), 0});
}

// Whether all ranks still have the same; and what there is to tell of it.
void Resident::State::settle() {
  using Words = std::array<std::uint64_t, 3>;
  const Words mine{resident.hash(), static_cast<std::uint64_t>(resident_bytes()), begun_at};
  std::vector<Words> all(static_cast<std::size_t>(world.size()));
  constexpr int kWords = static_cast<int>(mine.size());
  comm::check(MPI_Gather(mine.data(), kWords, MPI_UINT64_T, all.data(), kWords, MPI_UINT64_T, 0, world.get()),
              "MPI_Gather");
  if (world.rank() != 0) return;
  for (std::size_t rank = 0; rank < all.size(); ++rank) {
    if (all[rank][0] == mine[0]) continue;
    throw Error(ErrorCode::kInternal,
                fmt::format("rank {} holds another model or other volumes than rank 0", rank),
                "start the engine again, and report what was done before");
  }
  const std::scoped_lock lock(mutex);
  for (std::size_t rank = 0; rank < all.size(); ++rank) {
    status.ranks[rank].memory_bytes = static_cast<std::int64_t>(all[rank][1]);
    if (begun_at > 0 && resident.host_of[rank] == resident.host_of[0])
      status.ranks[rank].start_seconds = 1e-9 * static_cast<double>(all[rank][2] - begun_at);
  }
  status.volumes.clear();
  for (const auto& [checksum, volume] : resident.volumes.all())
    status.volumes.push_back({checksum, volume->path.string(), volume->info.dims, volume->memory_bytes()});
  status.faces = static_cast<std::int64_t>(resident.model.faces().size());
  status.edit = resident.model.edit();
  status.state_hash = mine[0];
}

// On all ranks; the failure is the same on all.
std::optional<Error> Resident::State::run(const v1::Command& command, const Send& send,
                                          const JobContext& job) {
  std::optional<Error> failure;
  try {
    row_of(command)->run(resident, command, send, job);
  } catch (const comm::AgreedError& error) {
    failure = error;
  }
  cancels.end();
  settle();
  return failure;
}

void Resident::State::follow() {
  for (;;) {
    doorbell.wait();
    begun_at = host_clock();
    const comm::Bytes bytes = world.broadcast({}, 0);
    v1::Command command;
    require(command.ParseFromArray(bytes.data(), static_cast<int>(bytes.size())), "a command of rank 0");
    if (command.has_shutdown()) return;
    require(row_of(command) != nullptr, "a command that ranks know");
    const JobContext job;
    cancels.begin(job);
    run(
        command, [](const google::protobuf::Message&) {}, job);
  }
}

void Resident::State::stop_others() {
  v1::Command command;
  command.mutable_shutdown();
  doorbell.ring();
  world.broadcast(bytes_of(command), 0);
}

void Resident::State::dispatch(CallQueue& queue) {
  while (const std::shared_ptr<Call> call = queue.next()) {
    try {
      carry_out(*call, queue);
    } catch (...) {
      // The ranks no longer agree, or cannot reach each other: nothing more can be done here.
      const Error error = comm::current_error();
      call->finish(error);
      queue.close(error);
      throw;
    }
    queue.done();
  }
}

void Resident::State::carry_out(Call& call, CallQueue& queue) {
  v1::Command command;
  try {
    call.context().check();
    command = call.take_command();
    command.set_job(call.id());
    if (!command.has_read_box() && !command.has_shutdown() && row_of(command) == nullptr)
      throw Error(ErrorCode::kUnsupported, "this engine does not know what is asked", "use a newer engine");
  } catch (...) {
    call.finish(comm::current_error());
    return;
  }
  if (command.has_read_box()) {
    read(call, command);
  } else if (command.has_shutdown()) {
    call.finish(std::nullopt);
    queue.close(Error(ErrorCode::kEngine, "the engine ends", "start it again"));
  } else {
    carry_out_together(command, call, queue);
  }
}

void Resident::State::carry_out_together(const v1::Command& command, Call& call, CallQueue& queue) {
  comm::Bytes bytes;
  try {
    bytes = bytes_of(command);
  } catch (...) {
    call.finish(comm::current_error());
    return;
  }
  const JobContext job([&](const Progress& progress) {
    if (std::this_thread::get_id() != main) return;
    read_between(queue);
    call.context().report(progress.fraction, progress.phase, progress.amounts);
  });
  begun_at = host_clock();
  doorbell.ring();
  world.broadcast(std::move(bytes), 0);
  cancels.begin(job, call.context());
  const std::optional<Error> failure = run(
      command, [&](const google::protobuf::Message& reply) { call.send(reply); }, job);
  call.finish(failure);
}

void Resident::State::read(Call& call, const v1::Command& command) {
  std::optional<Error> failure;
  try {
    read_box(resident, command.read_box(), [&](const google::protobuf::Message& reply) {
      call.context().check();
      call.send(reply);
    });
  } catch (...) {
    failure = comm::current_error();
  }
  call.finish(failure);
}

void Resident::State::read_between(CallQueue& queue) {
  while (const std::shared_ptr<Call> call = queue.next_read()) {
    v1::Command command;
    try {
      call->context().check();
      command = call->take_command();
      require(command.has_read_box(), "a read");
    } catch (...) {
      call->finish(comm::current_error());
      continue;
    }
    read(*call, command);
  }
}

}  // namespace footwall::service
