// EXTRACT-ALL: the statistics of every face, over the voxels that it cuts, on all ranks of a communicator.
// Based on: seed 004, chapter 3; differs in that sums are exact, so that the numbers do not depend on rank
// count, exchange strategy, threads or SIMD path.
#pragma once
#include <functional>
#include <memory>
#include <span>

#include "engine/comm/communicator.h"
#include "engine/extract/face.h"
#include "engine/extract/face_blobs.h"
#include "engine/extract/fault_statistics.h"
#include "storage/base/job_context.h"
#include "storage/survey/box.h"

namespace footwall::extract {

struct Input {
  survey::Index dims{0, 0, 0};  // of the survey; its voxels are [0, dims)
  double max_abs = 0;           // max |V| of the whole volume: scales the discontinuity's fixed point
  std::span<const Face> faces;  // the same on every rank
};

struct Result {
  std::vector<FaceStatistics> faces;  // on rank 0 in the order of the input; empty elsewhere
  std::vector<FaceBlobs> blobs;       // on rank 0, one for each whole-face computation asked for
  Report report;                      // on every rank
};

// Gives the values of `box`, [inline][crossline][sample], NaN for nulls. Called collectively, equally often
// on every rank, perhaps with an empty box; must throw on all ranks or on none.
using ReadBox = std::function<void(const survey::Box& box, std::span<float> values)>;

// A rank reads its box in slabs of so many inlines (the usual chunk of a volume file), which start at
// multiples of it.
inline constexpr std::int64_t kSlabInlines = 64;

// EXTRACT-ALL in two steps, for several sets of faces over one reading of the volume: each rank keeps its
// part in memory in between.
class LoadedSurvey {
 public:
  // 1 read the rank's box and a halo of one trace. Collective; throws kInvalid (no voxels), kMemory,
  // kCancelled, and what `read` throws.
  // pillars: of each rank along inlines and crosslines, see comm::RankGrid.
  LoadedSurvey(const comm::Communicator& parent, const survey::Index& dims, const ReadBox& read,
               const JobContext& job = {}, std::array<int, 2> pillars = {1, 1});
  ~LoadedSurvey();
  LoadedSurvey(const LoadedSurvey&) = delete;
  LoadedSurvey& operator=(const LoadedSurvey&) = delete;

  // 2 voxelize; 3 exchange; 4 compute; then gather the results at rank 0. input.dims is that of the reading.
  // Collective; as extract_all. Report::seconds.read is that of the constructor, and part of the total.
  Result extract(const Input& input, const Options& options, const JobContext& job = {});

  // The statistics of whole faults over distinct voxels, on rank 0; see fault_statistics.h. Collective;
  // throws as extract.
  std::vector<FaultStatistics> faults(const Input& input, const Options& options, const JobContext& job = {});

  // Of the last extract(), of this rank alone.
  const Seconds& own_seconds() const;

  const comm::RankGrid& grid() const;
  // Drops the voxels of other ranks that were kept for later extractions. By convention every rank calls it.
  void forget_cache();

  struct State;  // loaded_survey.h

 private:
  friend class Incremental;
  std::unique_ptr<State> state_;
};

// Steps, each a timed phase: 1 read the rank's box and a halo of one trace; 2 voxelize; 3 exchange; 4
// compute; then gather the results at rank 0. Collective; cancellable per face; errors are the same on every
// rank. Throws kUsage (options), kMemory, kCorrupt (a sample far above max_abs), kCancelled.
Result extract_all(const comm::Communicator& world, const Input& input, const Options& options,
                   const ReadBox& read, const JobContext& job = {});

// hash64 over (fault, owner, n, count, nulls, outside, mean, variance, min, max, discontinuity, contrast,
// offset_voxels, offset_score) of every face in order of its identity, little-endian, all NaNs alike.
std::uint64_t checksum_of(std::span<const Face> faces, std::span<const FaceStatistics> statistics);

}  // namespace footwall::extract
