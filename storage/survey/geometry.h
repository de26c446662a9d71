// Where a survey is: line numbers, samples, and the affine map between index space and the world.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "storage/survey/box.h"
#include "storage/survey/points.h"

namespace footwall::survey {

enum class Domain : std::uint8_t { kTime, kDepth };
enum class VerticalUnit : std::uint8_t { kMillisecond, kMetre, kFoot };

std::string_view name_of(Domain domain);      // "time", "depth"
std::string_view name_of(VerticalUnit unit);  // "ms", "m", "ft"
// Throw Error kUsage for any other text.
Domain domain_from(std::string_view name);
VerticalUnit vertical_unit_from(std::string_view name);

// Line numbers first, first + step, ...; step > 0 whatever the file's order.
struct LineAxis {
  std::int32_t first = 1;
  std::int32_t step = 1;
  std::int64_t count = 1;

  std::int64_t last() const { return first + (count - 1) * static_cast<std::int64_t>(step); }
  // The index of a line number, may lie outside [0, count); -1 also for numbers between lines.
  std::int64_t index_of(std::int64_t line) const;
  std::int64_t line_of(std::int64_t index) const { return first + index * static_cast<std::int64_t>(step); }
  friend bool operator==(const LineAxis&, const LineAxis&) = default;
};

// X = origin_x + per_inline_x * i + per_crossline_x * j, the same for Y: through sample centres, either
// handedness.
struct MapView {
  double origin_x = 0;
  double origin_y = 0;
  double per_inline_x = 0;
  double per_inline_y = 1;
  double per_crossline_x = 1;
  double per_crossline_y = 0;
  friend bool operator==(const MapView&, const MapView&) = default;
};

struct Geometry {
  LineAxis inlines;
  LineAxis crosslines;
  std::int64_t samples = 1;
  double z0 = 0;        // of sample 0, in vertical_unit, positive down
  double interval = 1;  // between samples, in vertical_unit, > 0
  Domain domain = Domain::kTime;
  VerticalUnit vertical_unit = VerticalUnit::kMillisecond;
  MapView map;
  std::string crs;                    // as the user named it; empty = not stated
  std::string horizontal_unit = "m";  // of X and Y: "m" or "ft"
  std::vector<std::string> assumed;   // what had to be assumed, in words, for `info`

  Index dims() const { return {inlines.count, crosslines.count, samples}; }
  Box box() const { return {{0, 0, 0}, dims()}; }
  bool has_metric_depth() const { return domain == Domain::kDepth; }

  WorldPoint world_of(const IndexPoint& p) const;
  // Throws Error kInvalid if the map is singular (lines on top of each other).
  IndexPoint index_of(const WorldPoint& p) const;
  // A position in metres east, north and up-positive-down z converted to metres; a time survey uses
  // `velocity` in m/s (two-way time, so half of it). For areas and dips; see has_metric_depth().
  double vertical_metres(double z_difference, double velocity_metres_per_second) const;
  double horizontal_metres(double difference) const;

  // Throws Error kInvalid naming what is wrong: counts, steps, intervals, not finite, singular map, more than
  // 2^23 voxels on an axis.
  void validate() const;
  friend bool operator==(const Geometry&, const Geometry&) = default;
};

}  // namespace footwall::survey
