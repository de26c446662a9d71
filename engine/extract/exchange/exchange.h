// What every exchange strategy is given and gives back.
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/extract/blocks.h"
#include "engine/extract/cache/voxel_cache.h"
#include "engine/extract/choice.h"
#include "engine/extract/computations.h"
#include "engine/extract/extract.h"
#include "engine/extract/face.h"

namespace footwall::extract {

struct Setup {
  comm::Communicator& world;
  const comm::RankGrid& grid;
  const Blocks& blocks;  // this rank's own voxels
  VoxelCache& cache;     // other ranks' voxels, from this extraction and earlier ones
  SentRecord& sent;      // what other ranks have of this one's
  const Input& input;
  std::span<const int> responsible;  // of every face
  const Options& options;
  const Choice& choice;  // the strategy with its parameters
  bool with_discontinuity;
  double scale;  // discontinuity_scale()
  // What needs a face's voxels on its responsible rank; none for a strategy that moves no voxels.
  std::span<const Computation* const> whole_face;
  int threads;
  const JobContext& job;

  const Face& face(std::size_t n) const { return input.faces[n]; }
  bool mine(std::size_t n) const { return responsible[n] == world.rank(); }
  // Traces around each voxel that are looked at.
  std::int32_t reach() const { return with_discontinuity ? 1 : 0; }
};

// The statistics of one face, by its place in the input.
struct Finished {
  std::int64_t face = 0;
  FaceStatistics statistics;
};

// The result of a whole-face computation for one face.
struct FinishedBlob {
  std::int64_t face = 0;
  std::size_t computation = 0;  // its place in Setup::whole_face
  std::vector<std::byte> bytes;
};

struct Outcome {
  std::vector<Finished> finished;  // the faces that this rank is responsible for
  std::vector<FinishedBlob> blobs;
  std::int64_t walked = 0;      // voxels that this rank voxelized
  Seconds seconds;              // of this rank
  std::int64_t cache_hits = 0;  // filled in by the caller, from Setup::cache
  std::int64_t cache_voxels = 0;
};

// Whether the whole closed triangle lies in the survey's box.
bool inside(const survey::LatticeTriangle& triangle, const survey::Index& dims);

// All are collective.
Outcome exchange_reduce(const Setup& setup);
Outcome exchange_minimum(const Setup& setup);
Outcome exchange_block(const Setup& setup);
Outcome exchange_bounding(const Setup& setup);
Outcome exchange_push(const Setup& setup);
void check_block(const Choice& choice);  // "block=B", B^3 voxels for each missing one

// A strategy is one file in this folder and one row in strategies.cpp. run and check are null for one that is
// known by name but not built.
struct ExchangeStrategy {
  std::string_view name;
  std::string_view help;
  bool moves_voxels;  // so that whole-face computations can be done
  Outcome (*run)(const Setup& setup);
  void (*check)(const Choice& choice);  // throws kUsage for parameters that it does not take
};
std::span<const ExchangeStrategy> exchange_strategies();
// The one that runs for a name of exchange_rows(): never "auto" itself.
const ExchangeStrategy& exchange_strategy(std::string_view name);

}  // namespace footwall::extract
