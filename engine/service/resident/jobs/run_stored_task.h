// A job of the command line on ranks that are there already.
#pragma once
#include "engine/comm/communicator.h"
#include "engine/service/ranks.pb.h"
#include "engine/service/resident/jobs/send.h"
#include "engine/service/task_files.h"
#include "storage/base/job_context.h"

namespace footwall::service {

// Collective; task.folder is looked at on rank 0, where in/ and out/ are emptied when this returns or throws.
// Sends the files that the job made as pieces, by name, "result.json" last. find_volume is asked on rank 0.
// Where not all ranks see the folder, rank 0 writes everything; an attribute volume and an isosurface's file
// are then refused with kUnsupported, because all ranks write them together. threads: of each rank. Throws on
// all ranks alike what unpack_task() and the jobs throw, kCancelled where the client has gone.
void run_stored_task(const comm::Communicator& world, const v1::StoredTask& task,
                     const FindVolume& find_volume, int threads, const Send& send, const JobContext& job);

// Whether a file that rank 0 makes in the folder is seen by all ranks. Collective; throws kIo on all ranks.
bool all_ranks_see(const comm::Communicator& world, const std::filesystem::path& folder);

}  // namespace footwall::service
