// What an extraction would compute and send on any number of ranks, worked out on one core without MPI:
// faces, boxes and responsible ranks are known alike to all, so every amount is a function of them. Based on:
// the idea of LogGOPSim and SMPI (a message schedule replayed against a cost model); differs in that the
// schedule is not traced but derived.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/comm/rank_grid.h"
#include "engine/extract/balance/area.h"
#include "engine/extract/choice.h"
#include "engine/extract/face.h"
#include "storage/base/job_context.h"

namespace footwall::extract {

// The voxels of a face (of `exact`) that one rank owns.
struct Piece {
  std::int32_t face = 0;  // its place in the input
  std::int32_t owner = 0;
  std::int64_t voxels = 0;
};

// Pieces of all faces, by face, then owner. They depend on the decomposition, but on no balancer: made once
// and used for many.
struct Pieces {
  std::vector<Piece> all;
  std::vector<std::size_t> first;    // of face n: all[first[n]] .. all[first[n + 1] - 1]
  std::vector<std::int64_t> voxels;  // of each face inside the survey
};
// Voxelizes every face once. Cancellable between faces; throws std::bad_alloc.
Pieces pieces_of(const comm::RankGrid& grid, std::span<const Face> faces, const JobContext& job = {});

// What one rank sends another.
struct Pair {
  int from = 0;
  int to = 0;
  std::int64_t voxels = 0;  // voxels of faces of `to` that `from` owns, once for every face that cuts them
  std::int64_t unique = 0;  // the same, each once; 0 where nobody asked for it
  std::int64_t pieces = 0;  // faces of `to` that have voxels of `from`
};

// The amounts of one extraction with these responsible ranks.
struct Amounts {
  int ranks = 1;
  std::vector<FixedArea> area;       // of the faces that each rank is responsible for
  std::vector<std::int64_t> voxels;  // of those faces
  std::vector<std::int64_t> owned;   // that each rank owns, of all faces (what `reduce` folds)
  std::vector<Pair> pairs;           // by from, then to; only where something is sent
  std::int64_t remote = 0;           // sum of Pair::voxels
  std::int64_t remote_unique = 0;    // sum of Pair::unique; 0 where nobody asked for it
  double area_deviation = 0;         // seed 004, equation 5.4, voxel^2
  double area_max_over_mean = 1;     // 1 where there is no area
  double voxels_max_over_mean = 1;   // 1 where there are no voxels
  double owned_max_over_mean = 1;
};
// count_unique: also counts each remote voxel once per pair of ranks, which voxelizes the faces again.
// Throws kInternal where pieces or ranks are not those of the faces.
Amounts amounts_of(const comm::RankGrid& grid, std::span<const Face> faces, const Pieces& pieces,
                   std::span<const int> responsible, bool count_unique = false, const JobContext& job = {});

// Bytes and messages of the exchange phase, over all ranks.
struct Sent {
  std::int64_t bytes = 0;
  std::int64_t messages = 0;
  bool exact = false;  // what the program would count; false: an estimate
  // Of the rank that has most to send or to receive.
  std::int64_t most_bytes = 0;
  std::int64_t most_messages = 0;
};

struct Exchanged {
  Choice strategy;
  // Traces around each voxel that are looked at: 1 for computations with a halo.
  int reach = 0;
};
// As exchange_rows(), without a cache kept from before. `reduce` is an estimate: how many bytes a partial sum
// needs depends on the values (kPartialBytes). Throws kUsage for a strategy that cannot be replayed.
Sent sent_by(const comm::RankGrid& grid, std::span<const Face> faces, const Pieces& pieces,
             std::span<const int> responsible, const Exchanged& exchanged, const JobContext& job = {});

// Bytes of a face's partial sum in a message of `reduce`: typical, not exact.
inline constexpr std::int64_t kPartialBytes = 56;

// What a machine needs for it: seconds. The defaults are this project's development machine, ranks on one
// host; `bench balance` takes others.
struct MachineCosts {
  double voxel = 6e-9;    // a voxel voxelized, looked up and folded
  double byte = 2.5e-10;  // a byte sent
  double message = 1e-6;  // a message sent
};
// The slowest rank's computing plus the busiest rank's sending: phases one after the other, as a report adds
// them up.
struct Predicted {
  double compute = 0;
  double exchange = 0;
  double total() const { return compute + exchange; }
};
Predicted predict(const Amounts& amounts, const Sent& sent, const MachineCosts& costs);

}  // namespace footwall::extract
