// What seed 004 published of its caching and load-balancing benchmarks.
#pragma once
#include <array>
#include <span>
#include <string_view>

namespace footwall::tasks {

// The columns of its tables, behind the serial run.
inline constexpr std::array<int, 8> kPublishedRanks{2, 4, 8, 16, 32, 64, 128, 256};

struct PublishedRow {
  std::string_view name;      // as printed: "MC-globalb"
  std::string_view exchange;  // the same as options write it
  std::string_view balance;
  // For each of kPublishedRanks. Negative: printed as "more than" its magnitude.
  std::array<double, kPublishedRanks.size()> values;
};

// Wall-clock seconds of benchmark 1, 2 or 3 (tables F.1, F.2, F.3), of four runs of 5 cycles x 2 repeats, on
// Power5+ CPUs. Tables 5.1 to 5.3 are these divided into the serial time.
std::span<const PublishedRow> published_seconds(int benchmark);
double published_serial_seconds(int benchmark);

// Standard deviation of the load in benchmark 2, voxel^2 (table F.4); of any exchange, whose name is empty.
std::span<const PublishedRow> published_deviations();

// The value for a number of ranks; null where it was not published.
const double* published_value(const PublishedRow& row, int ranks);

}  // namespace footwall::tasks
