// What every exchange strategy is given and gives back.
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/extract/block.h"
#include "engine/extract/extract.h"
#include "engine/extract/face.h"

namespace footwall::extract {

struct Setup {
  comm::Communicator& world;
  const comm::RankGrid& grid;
  const Block& block;
  const Input& input;
  std::span<const int> responsible;  // of every face
  std::string_view voxelizer;
  bool with_discontinuity;
  double scale;  // discontinuity_scale()
  int threads;
  const JobContext& job;

  const Face& face(std::size_t n) const { return input.faces[n]; }
  bool mine(std::size_t n) const { return responsible[n] == world.rank(); }
};

// The statistics of one face, by its place in the input.
struct Finished {
  std::int64_t face = 0;
  FaceStatistics statistics;
};

struct Outcome {
  std::vector<Finished> finished;  // the faces that this rank is responsible for
  std::int64_t walked = 0;         // voxels that this rank voxelized
  Seconds seconds;                 // of this rank
};

// Whether the whole closed triangle lies in the survey's box.
bool inside(const survey::LatticeTriangle& triangle, const survey::Index& dims);

// All are collective.
Outcome exchange_reduce(const Setup& setup);
Outcome exchange_minimum(const Setup& setup);

// A strategy is one file in this folder and one row in strategies.cpp. run is null for one that is known by
// name but not built.
struct ExchangeStrategy {
  std::string_view name;
  std::string_view help;
  Outcome (*run)(const Setup& setup);
};
std::span<const ExchangeStrategy> exchange_strategies();
// The one that runs for a name of exchange_rows(): never "auto" itself.
const ExchangeStrategy& exchange_strategy(std::string_view name);

}  // namespace footwall::extract
