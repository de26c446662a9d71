// A fault's chart: the plane in which its pillars are ordered and triangulated, found once and then kept, so
// that an edit changes nothing but the panels it touches.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "storage/survey/points.h"

namespace footwall::pillars {

// Closer than this is the same lattice point.
inline constexpr double kTouch = 1.0 / survey::kLatticePerVoxel;

using Vector3 = std::array<double, 3>;

// A pillar as the triangulation sees it. Positions are index space (voxels). Ids are positive and distinct.
struct PillarInput {
  std::int64_t id = 0;
  std::string name_for_messages;
  std::vector<survey::IndexPoint> nodes;
  std::vector<std::int64_t> node_ids =
      {};  // one for each node, or empty: then a vertex names the node's number
};

struct ChartPoint {
  double strike = 0;
  double dip = 0;
  double height = 0;  // along the normal
};

// An orthonormal frame with strike x dip = normal. Computed with + - * / sqrt alone.
struct Chart {
  Vector3 origin{0, 0, 0};
  Vector3 normal{0, 0, 0};  // of the plane that fits the nodes best (least squares)
  Vector3 strike{0, 0, 0};  // horizontal where the plane is not
  Vector3 dip{0, 0, 0};     // towards growing k where the plane is not horizontal
  // Where most pillars run, as (strike, dip) components: tells the fault's pillars from those that cross
  // them.
  std::array<double, 2> along{0, 1};

  bool empty() const { return normal == Vector3{0, 0, 0}; }
  ChartPoint from_index(const survey::IndexPoint& p) const;
  survey::IndexPoint to_index(const ChartPoint& p) const;
  // One line that reads back as the same bits. from_text throws Error kFormat for anything else.
  std::string to_text() const;
  static Chart from_text(std::string_view text);
  friend bool operator==(const Chart&, const Chart&) = default;
};

// Throws Error kInvalid if the nodes are fewer than three, not finite, or all on one line (within 1/256
// voxel). The normal's first component beyond 1e-9 is positive.
Chart fit_chart(std::span<const PillarInput> pillars);

// The same with the spread along the pillars and the spread from pillar to pillar weighing alike, however
// long the pillars are and however close together: for a fault picked on few lines, whose nodes' plain fit
// turns towards the section as soon as one of them sticks out. Nothing below three pillars with nodes, or
// where they do not span a plane. The nodes are finite.
std::optional<Chart> fit_chart_across(std::span<const PillarInput> pillars);

}  // namespace footwall::pillars
