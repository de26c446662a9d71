// footwall-engine workload: runs a scripted workload on all ranks, the seed's cpfw.
// Based on: seed 004, appendix B.1.2 and section 5.2.1.
//
// The result, one JSON object:
//   workload, size[3], ranks, threads, exchange, balance, voxelizer, compute[], seed, keep_cache
//   operations   {adds, removes, moves, extracts} as the seed counts them, and each operator by its name
//   seconds      of the operations: total (the slowest rank), apply (mesh operations), balance, voxelize,
//                exchange, compute (sums over EXTRACT-ALLs of the slowest rank in each); and, not in the
//                total, read: giving the voxels their values
//   slowest_rank, quickest_rank   seconds of the operations
//   faces, voxels, bytes_sent, messages, cache_hits   sums over EXTRACT-ALLs
//   cache_voxels                                      the most that were kept
//   load_max_over_mean, load_deviation                means over EXTRACT-ALLs (seed 004, equation 5.4)
//   exchanges    {name: EXTRACT-ALLs that ran it}
//   incremental  EXTRACT-ALLs that did only the faces touched since the one before
//   checksum     over the results of every EXTRACT-ALL, the same for any rank count and strategy
//   repeats[]    {slowest_rank, quickest_rank, seconds{}, extracts, faces, voxels, bytes_sent, messages,
//                cache_hits, load_max_over_mean, load_deviation, checksum}
// Reading the script is in none of the seconds.
#pragma once
#include <filesystem>

#include "engine/comm/communicator.h"
#include "engine/extract/face.h"
#include "storage/base/job_context.h"

namespace footwall::tasks {

struct WorkloadRun {
  std::filesystem::path script;  // on a file system that rank 0 sees
  std::filesystem::path result;  // written by rank 0
  extract::Options options;
  std::uint64_t seed = 1;   // of the voxels
  bool keep_cache = false;  // remote voxels stay from one repeat to the next
};

// Collective; the same Error on every rank: kUsage (options), kFormat (the script), kInvalid (an operation
// that is refused, by repeat and number), kMemory, kCancelled, kIo. The meshes need not be gone at the end of
// a repeat.
void run_workload(const comm::Communicator& world, const WorkloadRun& run, const JobContext& job);

}  // namespace footwall::tasks
