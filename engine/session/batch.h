// Runs one job on all ranks: read the job, open the volume, EXTRACT-ALL, write part files and result.json.
//
// result.json: {job, ranks, threads, exchange, balance, voxelizer, faces, voxels, bytes_sent, messages,
// load_max_over_mean, reason and predicted{balance,voxelize,exchange,compute,total} (why `auto` chose what
// ran, and the seconds it expected), checksum (16 hex digits), seconds{read,voxelize,exchange,compute,total},
// volume{path, checksum}, faults[{fault, name, faces, count, nulls, outside, mean, variance, min, max,
// discontinuity}], parts[{fault, name, file, faces, reused}]}. faults[]: over the distinct voxels of each.
// Faults whose whole part matches the job are not computed again; amounts, bytes and seconds are of what was
// computed, faces, voxels and checksum of everything.
//
// The volume is read once; faults are then taken in groups, whose parts are on disk before the next group
// starts: a job that is stopped loses one group at the most (a twentieth of the faces, or 20,000 of them).
#pragma once
#include <filesystem>

#include "engine/comm/communicator.h"
#include "storage/base/job_context.h"

namespace footwall::session {

// The exit status of the engine that was told to make room (SIGTERM): run the job again and it goes on.
inline constexpr int kResumable = 75;

struct BatchOptions {
  std::filesystem::path volume;  // where the volume is on this machine; empty = where the job says
  int threads = 0;               // of each rank; 0 = as the job says
};

// Collective; the same Error on every rank. Part files are removed or whole, never half; part n is written by
// rank n mod ranks, so the output folder must be one that all ranks see.
void run_batch(const comm::Communicator& world, const std::filesystem::path& job_path, const JobContext& job,
               const BatchOptions& options = {});

}  // namespace footwall::session
