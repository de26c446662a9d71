// What is known about a volume without reading its voxels: where it lies, what it means, how its values
// spread.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "storage/survey/geometry.h"

namespace footwall::volume {

enum class Role : std::uint8_t { kAmplitude, kDiscontinuity, kOther };
std::string_view name_of(Role role);  // "amplitude", "discontinuity", "other"
// Throws Error kUsage for any other text.
Role role_from(std::string_view name);

// counts[n] holds the values in [lo + n w, lo + (n + 1) w), w = (hi - lo) / 256; hi itself is in the last
// bin. The counts come from the percentiles' bins spread evenly over their width, so each is good to one such
// bin; they add up to Statistics::count exactly. lo = min, hi = max.
struct Histogram {
  static constexpr int kBins = 256;
  double lo = 0;
  double hi = 0;
  std::array<std::int64_t, kBins> counts{};
  friend bool operator==(const Histogram&, const Histogram&) = default;
};

// Over the samples that are not null. The same whatever the order of blocks, the chunk shape and the thread
// count: count, min, max and max_abs are exact, mean and stddev are rounded from exact integer sums
// (statistics.h). All values are 0 where count is 0.
struct Statistics {
  double min = 0;
  double max = 0;
  double mean = 0;
  double stddev = 0;   // of the population: divided by count
  double max_abs = 0;  // max |V|
  std::int64_t count = 0;
  std::int64_t null_count = 0;  // with the samples of dead traces; count + null_count = voxels
  std::int64_t live_traces = 0;
  // 101 values, percentile 0 (= min) to 100 (= max), nearest rank, good to 2^-7 of the value's magnitude.
  std::vector<double> percentiles;
  Histogram histogram;
  friend bool operator==(const Statistics&, const Statistics&) = default;
};

struct VolumeInfo {
  survey::Geometry geometry;        // of this volume: geometry.dims() == dims
  survey::Index dims{1, 1, 1};      // inlines, crosslines, samples
  survey::Index origin{0, 0, 0};    // of voxel (0,0,0) in the survey's index space
  std::optional<float> null_value;  // what stood for "no value" in the source; such samples are read as NaN
  Role role = Role::kAmplitude;
  bool high_is_fault = true;           // of a discontinuity: whether high values mean a fault
  std::string source;                  // the file or program it came from, in words
  std::string provenance_json = "{}";  // how it was made: any JSON
  Statistics statistics;
  std::uint64_t checksum = 0;    // hash64 of the table of chunk hashes, little-endian
  survey::Index chunk{1, 1, 1};  // the stored blocks; read boxes made of whole ones where you can
  std::int64_t bytes = 0;        // of the file
};

}  // namespace footwall::volume
