// What goes into EXTRACT-ALL and what comes out of it, as plain values.
#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "storage/survey/points.h"

namespace footwall::extract {

// One triangle of a fault's mesh. Its identity is (fault, owner, n): owner is the pillar or panel it belongs
// to.
struct Face {
  std::int64_t fault = 0;
  std::int64_t owner = 0;
  std::int32_t n = 0;
  survey::LatticeTriangle triangle;
  friend bool operator==(const Face&, const Face&) = default;
};

enum class Outside : std::uint8_t {
  kInside = 0,  // the closed triangle lies in the survey's box [-1/2, n-1/2]
  kPartly = 1,  // some of its voxels are counted, some are not there
  kWholly = 2   // no voxel of the survey is touched
};

inline constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

// The statistics of one face over VOXELIZE(face) inside the survey. NaN = undefined.
struct FaceStatistics {
  std::int64_t count = 0;  // voxels with a finite value
  std::int64_t nulls = 0;  // voxels that are null, NaN or infinite
  Outside outside = Outside::kInside;
  double mean = kUndefined;      // NaN where count is 0
  double variance = kUndefined;  // sample variance; 0 where count is 0 or 1
  double min = kUndefined;       // NaN where count is 0; never -0
  double max = kUndefined;
  double discontinuity = kUndefined;  // 0..1; NaN where not asked for or not defined
  // See probes.h; NaN where not asked for or not defined.
  double contrast = kUndefined;       // -1..1: discontinuity above that of the face moved to either side
  double offset_voxels = kUndefined;  // -8..8, whole: where along the fault's normal it is highest
  double offset_score = kUndefined;   // the discontinuity there
};

struct Options {
  std::string exchange = "auto";  // a name of exchange_rows(), perhaps with parameters: "block=2"
  std::string balance = "auto";   // a name of balance_rows(), perhaps with parameters
  std::string voxelizer = "exact";
  // Names of computations.h; empty = those computed by default. count, mean, variance, min and max come
  // together.
  std::vector<std::string> compute;
  int threads = 1;                       // OpenMP threads of each rank, at least 1
  std::array<int, 2> pillars{1, 1};      // of each rank along inlines and crosslines, see RankGrid
  std::int64_t cache_bytes = 1LL << 30;  // limit of a rank's remote voxels
  double snr = 0;                        // dB, for `lot`; 0 = not given
  std::string filter = "band=4,32";      // of `filter`, see face_filter.h
  std::string lot_order = "2d";          // of `lot`, see lot.h
  // For measuring: ranks wait for the slowest before messages that all take part in, and the waiting is told
  // apart from the exchange. Changes no result.
  bool phases_apart = false;
  friend bool operator==(const Options&, const Options&) = default;
};

// Seconds are of the slowest rank in each phase, amounts are sums over ranks.
struct Seconds {
  double read = 0;
  double balance = 0;   // who is responsible for what
  double voxelize = 0;  // voxelizing and, with `reduce`, folding on the way
  double exchange = 0;  // messages that nothing is done beside, and waiting for slower ranks on the way
  double compute = 0;
  double wait = 0;  // for slower ranks, where Options::phases_apart tells it from the rest; else 0
  double total = 0;
};

struct Report {
  std::string exchange;  // the strategy that ran: never "auto"
  std::string balance;
  int ranks = 1;
  int threads = 1;
  std::int64_t faces = 0;
  std::int64_t voxels = 0;       // count + nulls over all faces
  std::int64_t walked_here = 0;  // of them, by this rank: the only number that differs between ranks
  std::int64_t bytes_sent = 0;   // by the exchange phase, sizes included
  std::int64_t messages = 0;
  std::int64_t most_bytes = 0;  // that one rank sent; of several extractions, the sum of each one's most
  std::int64_t most_messages = 0;
  double load_max_over_mean = 1;  // of the voxels each rank walked; 1 where there are none
  double load_deviation = 0;      // standard deviation over ranks of the area (voxel^2) each is responsible
                                  // for: seed 004, equation 5.4, of this extraction
  // The area that each rank is responsible for, in units of 2^-16 voxel^2 (balance/area.h).
  std::vector<std::int64_t> loads;
  std::int64_t cache_hits = 0;    // remote voxels that were still there from an earlier extraction
  std::int64_t cache_voxels = 0;  // remote voxels kept, over all ranks
  std::string reason;             // why `auto` chose what ran; empty where nothing was left to choose
  Seconds predicted;              // by the cost model; zeros where it was not asked
  Seconds quickest;               // as `seconds`, of the quickest rank
  std::uint64_t checksum = 0;     // of ids and statistics, see checksum_of()
  Seconds seconds;
};

}  // namespace footwall::extract
