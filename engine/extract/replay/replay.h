// What an extraction would compute and send on any number of ranks, worked out on one core without MPI:
// faces, boxes and responsible ranks are known alike to all, so every amount is a function of them. Based on:
// the idea of LogGOPSim and SMPI (a message schedule replayed against a cost model); differs in that the
// schedule is not traced but derived.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/comm/rank_grid.h"
#include "engine/extract/balance/area.h"
#include "engine/extract/choice.h"
#include "engine/extract/face.h"
#include "storage/base/job_context.h"

namespace footwall::extract {

// The voxels of a face (as `exact` counts them) that one rank owns.
struct Piece {
  std::int32_t face = 0;  // its place in the input
  std::int32_t owner = 0;
  std::int64_t voxels = 0;  // > 0
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

// What one rank has of another's faces.
struct Pair {
  int from = 0;             // the owner
  int to = 0;               // the responsible rank
  std::int64_t voxels = 0;  // once for every face that cuts them
  std::int64_t pieces = 0;  // faces of `to` that have voxels of `from`
};

// The amounts of one extraction with these responsible ranks.
struct Amounts {
  int ranks = 1;
  std::vector<FixedArea> area;       // of the faces that each rank is responsible for
  std::vector<std::int64_t> voxels;  // of those faces
  std::vector<std::int64_t> owned;   // that each rank owns, of all faces (what `reduce` folds)
  std::vector<Pair> pairs;           // by from, then to; from != to
  std::int64_t remote = 0;           // sum of Pair::voxels
  double area_deviation = 0;         // seed 004, equation 5.4, voxel^2
  double area_max_over_mean = 1;     // 1 where there is no area
  double voxels_max_over_mean = 1;   // 1 where there are no voxels
  double owned_max_over_mean = 1;
};
// Throws kInternal where pieces or ranks are not those of the faces.
Amounts amounts_of(const comm::RankGrid& grid, std::span<const Face> faces, const Pieces& pieces,
                   std::span<const int> responsible);

// What a machine needs, in seconds. The defaults are near this project's development machine, ranks on one
// host.
struct MachineCosts {
  double voxel = 6e-9;    // a voxel voxelized, looked up and folded
  double byte = 2.5e-10;  // a byte sent
  double message = 1e-6;  // a message sent
};

// What one rank sends and receives in the exchange phase.
struct Traffic {
  std::int64_t bytes_out = 0;
  std::int64_t bytes_in = 0;
  std::int64_t messages_out = 0;
  std::int64_t messages_in = 0;
};

struct Sent {
  std::vector<Traffic> of_rank;
  std::int64_t bytes = 0;     // over all ranks
  std::int64_t messages = 0;  // over all ranks
  std::int64_t voxels = 0;    // values among them; 0 for `reduce`
  bool exact = false;         // the contents of the messages as the program sends them; false: an estimate
  bool at_owners = false;     // the owners compute (`reduce`), not the responsible ranks
  // Seconds of the rank that has most to send, or most to receive.
  double busiest(const MachineCosts& costs) const;
};

// The exchange phase of a strategy (exchange/strategies.cpp) with nothing kept from before: contents of
// messages, without what the transport adds to tell sizes. A rank holds its own voxels and a halo of one
// trace around them; each of the others is sent once to each rank, however many of its faces cut it.
//   minimum   12 bytes for each voxel asked for, and 4 for its value
//   block=B   the same; 4 bytes for each voxel of the blocks
//   bounding  4 bytes for each voxel of the faces' bounding boxes; nothing is asked for
//   push      4 bytes for each voxel
//   reduce    kPartialBytes for each piece: an estimate, since what a sum needs depends on the values
// reach: traces around each voxel that are looked at, 1 for computations with a halo. Throws kUsage for
// another strategy, kInternal as amounts_of. Cancellable between ranks.
Sent sent_by(const comm::RankGrid& grid, std::span<const Face> faces, const Pieces& pieces,
             std::span<const int> responsible, const Choice& strategy, int reach = 0,
             const JobContext& job = {});

// Bytes of a face's partial sum in a message of `reduce`: typical.
inline constexpr std::int64_t kPartialBytes = 56;

// The slowest rank's computing, and the busiest rank's exchange: one after the other, as a report has them.
struct Predicted {
  double compute = 0;
  double exchange = 0;
  double total() const { return compute + exchange; }
};
Predicted predict(const Amounts& amounts, const Sent& sent, const MachineCosts& costs = {});

}  // namespace footwall::extract
