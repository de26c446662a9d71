// The min/max octree over the bricks of a volume, as a pyramid of tables without pointers: the node (a, b, c)
// of a level holds the nodes 2a, 2a + 1 and so on of the level below. It tells where the isovalue may be met,
// and walks there from the front to the back.
// Based on: seed 003, section 3.2; differs in that nodes carry nothing but their range, and that leaves are
// bricks of any size, 8 x 8 x 8 cells as a volume's tables have them unless asked otherwise.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/isosurface/brick_ranges.h"
#include "engine/render/camera.h"
#include "engine/render/lit_surface.h"
#include "storage/survey/vector.h"

namespace footwall::isosurface {

// From where the volume is seen, in its index space (samples along inlines, crosslines, samples). An affine
// map keeps what hides what, so no depth is lost by asking there.
struct Viewpoint {
  survey::Vector3 place;  // perspective: the eye; else the direction of view, of any length
  bool perspective = true;
};
// placement: from index space to the scene. Throws Error kInvalid for one that is singular or not finite.
Viewpoint viewpoint_of(const render::Camera& camera, const render::Placement& placement);

inline constexpr survey::Index kBrickCells{8, 8, 8};

// The ranges of leaves of n x m x k cells: entry (a, b, c) covers the samples n a .. n a + n inclusive, and
// so on, cut at the volume. As brick_ranges(), which it equals for 8 x 8 x 8. Reads every sample of `volume`,
// which must be whole. Throws Error kInvalid for a part of a volume and for cells below 1.
BrickRanges leaf_ranges(const Field& volume, const survey::Index& leaf_cells, int threads);

class Octree {
 public:
  // leaves: ranges of leaves of `leaf_cells` cells along each axis, in a volume of so many samples; they are
  // copied. Throws Error kInvalid where sizes do not fit.
  Octree(const Bricks& leaves, const survey::Index& volume_size,
         const survey::Index& leaf_cells = kBrickCells);

  struct Node {
    int level = 0;  // 0: a leaf
    survey::Index at{0, 0, 0};
    friend bool operator==(const Node&, const Node&) = default;
  };

  // The last one has a single node. At least 1.
  int levels() const { return static_cast<int>(levels_.size()); }
  const survey::Index& dims(int level) const { return at_level(level).dims; }
  const survey::Index& volume_size() const { return volume_size_; }
  const survey::Index& leaf_cells() const { return leaf_cells_; }
  Bricks ranges(int level) const { return at_level(level).tables(); }

  // The cells of the volume in a node; none where the volume has no cells.
  survey::Box cells_of(const Node& node) const;
  // Whether a node has a sample below the isovalue and one at or above it: it may hold triangles.
  bool is_active(const Node& node, float isovalue) const {
    const BrickRanges& level = at_level(node.level);
    const auto n =
        static_cast<std::size_t>((node.at[0] * level.dims[1] + node.at[1]) * level.dims[2] + node.at[2]);
    return level.min[n] < isovalue && isovalue <= level.max[n];
  }

  // Calls visit(node) -> bool for active nodes, from the root on: true goes on to the node's children. Of two
  // nodes of which one can hide something of the other, the one in front comes first (nodes and those inside
  // them aside): no line of sight meets a later one before an earlier one.
  template <class Visit>
  void front_to_back(const Viewpoint& from, float isovalue, Visit&& visit) const {
    walk(from, isovalue, {levels() - 1, {0, 0, 0}}, visit);
  }
  // All active leaves, front to back. `level`: nodes of that level instead.
  std::vector<survey::Index> active(const Viewpoint& from, float isovalue, int level = 0) const;

 private:
  const BrickRanges& at_level(int level) const { return levels_[static_cast<std::size_t>(level)]; }
  // Bit n: along axis n the upper child is the nearer one.
  unsigned nearest_child(const Viewpoint& from, const Node& node) const;

  template <class Visit>
  void walk(const Viewpoint& from, float isovalue, const Node& node, Visit& visit) const {
    if (!is_active(node, isovalue) || !visit(node) || node.level == 0) return;
    const unsigned nearest = nearest_child(from, node);
    const survey::Index& below = dims(node.level - 1);
    // By how many of the planes between children lie before the child.
    for (const unsigned order : {0U, 1U, 2U, 4U, 3U, 5U, 6U, 7U}) {
      const unsigned child = order ^ nearest;
      Node next{node.level - 1, {0, 0, 0}};
      bool is_there = true;
      for (unsigned axis = 0; axis < 3; ++axis) {
        next.at[axis] = 2 * node.at[axis] + (child >> axis & 1U);
        is_there = is_there && next.at[axis] < below[axis];
      }
      if (is_there) walk(from, isovalue, next, visit);
    }
  }

  survey::Index volume_size_;
  survey::Index leaf_cells_;
  std::vector<BrickRanges> levels_;
};

}  // namespace footwall::isosurface
