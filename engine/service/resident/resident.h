// The engine as a service, on all ranks: commands that rank 0 gives are carried out by all of them together,
// on the state that stays between commands. Idle ranks sleep (doorbell.h).
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/service/queue/call_queue.h"
#include "engine/service/resident_status.h"

namespace footwall::service {

struct ResidentOptions {
  std::filesystem::path folder;   // private, on each host; doorbells and scratch files live here
  std::filesystem::path volumes;  // where volumes are found by checksum; may be empty
  int threads = 1;                // of each rank
  std::int64_t memory_bytes = 0;  // of each host, for voxels, faces and pictures; 0: what is free there
  // Of each rank, the lowest rank of its host; empty: as MPI tells. For tests, which have one host alone.
  std::vector<int> host_of;
  // What a rank does where its host's first rank, or rank 0, has died: it may wait for a message that never
  // comes. None: the process ends. Called on a thread of its own.
  std::function<void()> left_alone;
};

class Resident {
 public:
  // Collective; the same Error on every rank.
  Resident(comm::Communicator& world, const ResidentOptions& options);
  ~Resident();
  Resident(const Resident&) = delete;
  Resident& operator=(const Resident&) = delete;

  // Serves until a Shutdown command or the queue's close. Rank 0 gives its queue, the others null. A command
  // that fails is its call's error, alike on all ranks, and serving goes on; throws where ranks no longer
  // agree (kInternal) or MPI fails (kEngine): then the program must end on all ranks.
  void serve(CallQueue* queue);

  ResidentStatus status() const;  // rank 0, from any thread

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace footwall::service
