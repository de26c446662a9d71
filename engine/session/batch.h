// Runs one job on all ranks: read the job, open the volume, EXTRACT-ALL, write part files and result.json.
//
// result.json: {job, ranks, threads, exchange, balance, voxelizer, faces, voxels, bytes_sent, messages,
// load_max_over_mean, each_rank (rank_log.h), reason and predicted{balance,voxelize,exchange,compute,total}
// (why `auto` chose what ran, and the seconds it expected), checksum (16 hex digits),
// seconds{read,voxelize,exchange,compute,total}, volume{path, checksum}, faults[{fault, name, faces, count,
// nulls, outside, mean, variance, min, max, discontinuity}], parts[{fault, name, file, faces, reused}]}.
// faults[]: over the distinct voxels of each. Faults whose whole part matches the job are not computed again;
// amounts, bytes and seconds are of what was computed, faces, voxels and checksum of everything.
//
// The volume is read once; faults are then taken in groups, whose parts are on disk before the next group
// starts: a job that is stopped loses one group at the most. A group has as many faces as take about ten
// seconds, 20,000 or a twentieth of all at the most, but whole faults. A line about each rank is added to
// log.txt beside result.json (rank_log.h), also by a run that was stopped or failed.
#pragma once
#include <filesystem>
#include <functional>
#include <string_view>

#include "engine/comm/communicator.h"
#include "engine/session/job.h"
#include "storage/base/job_context.h"

namespace footwall::session {

// The exit status of the engine that was told to make room (SIGTERM, SIGUSR1): run the job again and it goes
// on.
inline constexpr int kResumable = 75;

struct BatchOptions {
  std::filesystem::path volume;  // where the volume is on this machine; empty = where the job says
  int threads = 0;               // of each rank; 0 = as the job says
  bool one_writer = false;       // rank 0 writes all parts: where no folder is seen by all ranks
  // On rank 0, once a part is on disk. What it throws ends the job on all ranks.
  std::function<void(const std::filesystem::path&)> part_written = {};
};

// Whether a file of this name in the output folder is one that a later run goes on with: a part, or the log.
bool goes_on_with(std::string_view name);

// Collective; the same Error on every rank. Part files are removed or whole, never half; part n is written by
// rank n mod ranks, so the output folder must be one that all ranks see, unless there is one writer.
void run_batch(const comm::Communicator& world, const std::filesystem::path& job_path, const JobContext& job,
               const BatchOptions& options = {});
// The same for files that rank 0 has read; job_path: the job's name, and from where its relative paths go.
void run_batch(const comm::Communicator& world, const JobFiles& files, const std::filesystem::path& job_path,
               const JobContext& job, const BatchOptions& options = {});

}  // namespace footwall::session
