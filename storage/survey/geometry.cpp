#include "storage/survey/geometry.h"

#include <fmt/format.h>

#include <cmath>

#include "storage/base/error.h"
#include "storage/survey/units.h"

namespace footwall::survey {
namespace {

constexpr std::int64_t kMostVoxelsOnAxis = std::int64_t{1} << 23;

[[noreturn]] void refuse(const std::string& why) {
  throw Error(ErrorCode::kInvalid, "the survey's geometry cannot be used: " + why,
              "check the line numbers, coordinates and sample interval it was made from");
}

void check_axis(std::string_view name, std::int64_t count) {
  if (count < 1 || count > kMostVoxelsOnAxis)
    refuse(fmt::format("{} {}; 1 to {} are possible", count, name, kMostVoxelsOnAxis));
}

double determinant(const MapView& m) {
  return m.per_inline_x * m.per_crossline_y - m.per_inline_y * m.per_crossline_x;
}

}  // namespace

std::string_view name_of(Domain domain) {
  return domain == Domain::kTime ? "time" : "depth";
}

std::string_view name_of(VerticalUnit unit) {
  if (unit == VerticalUnit::kMillisecond) return "ms";
  return unit == VerticalUnit::kMetre ? "m" : "ft";
}

Domain domain_from(std::string_view name) {
  if (name == "time") return Domain::kTime;
  if (name == "depth") return Domain::kDepth;
  throw Error(ErrorCode::kUsage, fmt::format("'{}' is not a domain", name), "use time or depth");
}

VerticalUnit vertical_unit_from(std::string_view name) {
  if (name == "ms") return VerticalUnit::kMillisecond;
  if (name == "m") return VerticalUnit::kMetre;
  if (name == "ft") return VerticalUnit::kFoot;
  throw Error(ErrorCode::kUsage, fmt::format("'{}' is not a vertical unit", name), "use ms, m or ft");
}

std::int64_t LineAxis::index_of(std::int64_t line) const {
  const std::int64_t offset = line - first;
  if (offset % step != 0) return -1;
  return offset / step;
}

WorldPoint Geometry::world_of(const IndexPoint& p) const {
  return {map.origin_x + map.per_inline_x * p.i + map.per_crossline_x * p.j,
          map.origin_y + map.per_inline_y * p.i + map.per_crossline_y * p.j, z0 + interval * p.k};
}

IndexPoint Geometry::index_of(const WorldPoint& p) const {
  const double det = determinant(map);
  if (det == 0 || !std::isfinite(det)) refuse("its map to X and Y is singular");
  const double x = p.x - map.origin_x;
  const double y = p.y - map.origin_y;
  return {(x * map.per_crossline_y - y * map.per_crossline_x) / det,
          (y * map.per_inline_x - x * map.per_inline_y) / det, (p.z - z0) / interval};
}

double Geometry::vertical_metres(double z_difference, double velocity_metres_per_second) const {
  switch (vertical_unit) {
    case VerticalUnit::kMillisecond:
      return z_difference * 1e-3 * velocity_metres_per_second / 2;
    case VerticalUnit::kFoot:
      return z_difference * kMetresPerFoot;
    case VerticalUnit::kMetre:
      break;
  }
  return z_difference;
}

double Geometry::horizontal_metres(double difference) const {
  return horizontal_unit == "ft" ? difference * kMetresPerFoot : difference;
}

void Geometry::validate() const {
  check_axis("inlines", inlines.count);
  check_axis("crosslines", crosslines.count);
  check_axis("samples", samples);
  if (inlines.step < 1 || crosslines.step < 1) refuse("a line step below 1");
  if (!(interval > 0) || !std::isfinite(interval)) refuse(fmt::format("sample interval {}", interval));
  if (!std::isfinite(z0)) refuse(fmt::format("first sample at {}", z0));
  for (const double value : {map.origin_x, map.origin_y, map.per_inline_x, map.per_inline_y,
                             map.per_crossline_x, map.per_crossline_y}) {
    if (!std::isfinite(value)) refuse("a coordinate that is not finite");
  }
  if (determinant(map) == 0) refuse("inlines and crosslines run in the same direction");
  if ((domain == Domain::kTime) != (vertical_unit == VerticalUnit::kMillisecond)) {
    refuse(fmt::format("domain {} with vertical unit {}", name_of(domain), name_of(vertical_unit)));
  }
  if (horizontal_unit != "m" && horizontal_unit != "ft") refuse("horizontal unit '" + horizontal_unit + "'");
}

}  // namespace footwall::survey
