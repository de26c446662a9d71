#include "ui/model/provisional_move.h"

#include <algorithm>
#include <cmath>

namespace footwall::ui {
namespace {

using survey::Pillar;
using survey::WorldPoint;

// How far each node of a pillar has gone; linear between nodes.
class Displacement {
 public:
  Displacement(const Pillar& before, const std::map<std::int64_t, WorldPoint>& moved) {
    for (const survey::PillarNode& node : before.nodes) {
      const auto found = moved.find(node.id);
      const WorldPoint to = found == moved.end() ? node.position : found->second;
      by_.push_back({to.x - node.position.x, to.y - node.position.y, to.z - node.position.z});
    }
  }
  // part: 0 at the first node, 1 at the last.
  WorldPoint at(double part) const {
    const double place = part * static_cast<double>(by_.size() - 1);
    const auto from = std::min(static_cast<std::size_t>(place), by_.size() - 1);
    const std::size_t to = std::min(from + 1, by_.size() - 1);
    const double rest = place - static_cast<double>(from);
    return {by_[from].x + rest * (by_[to].x - by_[from].x), by_[from].y + rest * (by_[to].y - by_[from].y),
            by_[from].z + rest * (by_[to].z - by_[from].z)};
  }

 private:
  std::vector<WorldPoint> by_;
};

}  // namespace

std::vector<Pillar> moved_provisionally(std::vector<Pillar> pillars,
                                        const std::map<std::int64_t, WorldPoint>& moved) {
  std::map<std::int64_t, Displacement> displacements;
  for (const Pillar& pillar : pillars) {
    const bool touched = std::ranges::any_of(
        pillar.nodes, [&](const survey::PillarNode& node) { return moved.contains(node.id); });
    if (touched) displacements.emplace(pillar.id, Displacement(pillar, moved));
  }
  for (Pillar& pillar : pillars) {
    const auto own = displacements.find(pillar.id);
    const auto a = displacements.find(pillar.parent_a);
    const auto b = displacements.find(pillar.parent_b);
    const bool follows = own == displacements.end() && pillar.kind == survey::PillarKind::kInterpolated;
    for (std::size_t n = 0; n < pillar.nodes.size(); ++n) {
      WorldPoint& p = pillar.nodes[n].position;
      const auto found = moved.find(pillar.nodes[n].id);
      if (found != moved.end()) p = found->second;
      if (!follows) continue;
      const double part =
          pillar.nodes.size() < 2 ? 0 : static_cast<double>(n) / static_cast<double>(pillar.nodes.size() - 1);
      const auto follow = [&](const auto& parent, double weight) {
        if (parent == displacements.end()) return;
        const WorldPoint by = parent->second.at(part);
        p = {p.x + weight * by.x, p.y + weight * by.y, p.z + weight * by.z};
      };
      follow(a, 1 - pillar.parameter);
      follow(b, pillar.parameter);
    }
  }
  return pillars;
}

}  // namespace footwall::ui
