// `footwall bench balance`: how the balancers share out faces, and what that would cost, on any number of
// ranks, replayed on one core (engine/extract/replay).
// Based on: seed 004, section 5.3.3, figure 5.3 and table F.4.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/tasks/extractions.h"
#include "storage/base/job_context.h"

namespace footwall::tasks {

struct BenchBalanceOptions {
  std::vector<int> ranks{1, 2, 4, 8, 16, 32, 64, 128, 256};
  std::vector<std::array<int, 2>> pillars{{1, 1}};  // of each rank, see RankGrid
  // As --balance takes them, and "local=D,running" (the mean of the faces met so far); empty: all, with the
  // thresholds and distances below.
  std::vector<std::string> strategies;
  std::vector<double> deltas{0};  // thresholds, in mean face areas
  std::vector<int> taus{2};       // beside the infinite one; empty: 1 .. diameter of each grid
  std::string exchange = "push";  // whose time is predicted
};

// Means over the EXTRACT-ALLs, but for `published`.
struct BalanceRow {
  int ranks = 1;
  std::array<int, 2> pillars{1, 1};
  std::string strategy;
  double deviation = 0;  // of the ranks' areas, voxel^2: seed 004, equation 5.4
  double area_max_over_mean = 1;
  double voxels_max_over_mean = 1;
  double remote_voxels = 0;    // voxels of faces that another than the responsible rank owns
  double sent_bytes = 0;       // by the exchange
  double moved_faces = 0;      // not with their centroid rank
  double compute_seconds = 0;  // predicted
  double exchange_seconds = 0;
  double decision_seconds = 0;      // measured: processor time of the balancer
  std::optional<double> published;  // the seed's deviation (table F.4), for its benchmark 2
  double seconds() const { return compute_seconds + exchange_seconds; }
};

struct BenchBalanceResult {
  survey::Index dims{0, 0, 0};
  std::int64_t faces = 0;  // of the last EXTRACT-ALL
  std::int64_t extractions = 0;
  double mean_area = 0;    // voxel^2, of all faces
  double mean_voxels = 0;  // of an EXTRACT-ALL
  std::vector<BalanceRow> rows;
  std::int64_t checked = 0;  // decisions that were compared with the seed's pseudocode
};

// Every decision is checked before it counts: one rank for every face, sums that agree, and the pseudocode
// for up to 16 ranks. Throws Error kInternal where one is wrong, kUsage for options that make no sense,
// kCancelled.
BenchBalanceResult bench_balance(const Extractions& extractions, const BenchBalanceOptions& options,
                                 const JobContext& job);

}  // namespace footwall::tasks
