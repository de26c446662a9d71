// Between two pillars by the straight line at equal normalised length: simple, and never outside the two.
#include <fmt/format.h>
#include <cmath>

#include "storage/project/detail/edit_state.h"

namespace footwall::project::detail {
namespace {

double distance(const survey::WorldPoint& a, const survey::WorldPoint& b) {
  const double x = b.x - a.x, y = b.y - a.y, z = b.z - a.z;
  return std::sqrt(x * x + y * y + z * z);  // not hypot: stored numbers do not depend on the C library
}

survey::WorldPoint mixed(const survey::WorldPoint& a, const survey::WorldPoint& b, double t) {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
}

// The point at fraction s of the polyline's length.
survey::WorldPoint point_at(const std::vector<survey::PillarNode>& nodes, double s) {
  double total = 0;
  for (std::size_t n = 1; n < nodes.size(); ++n) total += distance(nodes[n - 1].position, nodes[n].position);
  double left = s * total;
  for (std::size_t n = 1; n < nodes.size(); ++n) {
    const double length = distance(nodes[n - 1].position, nodes[n].position);
    if (left <= length && length > 0) return mixed(nodes[n - 1].position, nodes[n].position, left / length);
    left -= length;
  }
  return nodes.back().position;
}

const survey::Pillar& found(std::span<const survey::Pillar> pillars, std::int64_t id) {
  for (const survey::Pillar& pillar : pillars) {
    if (pillar.id == id && !pillar.nodes.empty()) return pillar;
  }
  throw Error(ErrorCode::kCorrupt,
              fmt::format("an interpolated pillar has the parent {}, which is not there", id));
}

}  // namespace

std::vector<std::vector<survey::WorldPoint>> ruled(const FaultRecord&,
                                                   std::span<const survey::Pillar> pillars,
                                                   std::span<const survey::Pillar> children) {
  std::vector<std::vector<survey::WorldPoint>> lines;
  for (const survey::Pillar& child : children) {
    const survey::Pillar& a = found(pillars, child.parent_a);
    survey::Pillar b = found(pillars, child.parent_b);
    // One of the two may have been picked upwards.
    const auto& first = a.nodes.front().position;
    const auto& last = a.nodes.back().position;
    if (distance(first, b.nodes.front().position) + distance(last, b.nodes.back().position) >
        distance(first, b.nodes.back().position) + distance(last, b.nodes.front().position)) {
      std::reverse(b.nodes.begin(), b.nodes.end());
    }
    const std::size_t count = std::max<std::size_t>(child.nodes.size(), 1);
    std::vector<survey::WorldPoint> line;
    for (std::size_t n = 0; n < count; ++n) {
      const double s = count == 1 ? 0.5 : static_cast<double>(n) / static_cast<double>(count - 1);
      line.push_back(mixed(point_at(a.nodes, s), point_at(b.nodes, s), child.parameter));
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace footwall::project::detail
