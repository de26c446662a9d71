#include "engine/isosurface/visible/octree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/isosurface/detail/threads.h"
#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

survey::Index leaves_of(const survey::Index& volume_size, const survey::Index& leaf_cells) {
  survey::Index dims{};
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t cells = volume_size[axis] - 1;
    dims[axis] = std::max<std::int64_t>(1, (cells + leaf_cells[axis] - 1) / leaf_cells[axis]);
  }
  return dims;
}

bool are_positive(const survey::Index& index) {
  return index[0] >= 1 && index[1] >= 1 && index[2] >= 1;
}

BrickRanges empty_ranges(const survey::Index& dims) {
  BrickRanges ranges;
  ranges.dims = dims;
  const auto count = static_cast<std::size_t>(dims[0] * dims[1] * dims[2]);
  ranges.min.assign(count, kInf);
  ranges.max.assign(count, -kInf);
  ranges.has_null.assign(count, 0);
  return ranges;
}

BrickRanges level_above(const BrickRanges& below) {
  BrickRanges above =
      empty_ranges({(below.dims[0] + 1) / 2, (below.dims[1] + 1) / 2, (below.dims[2] + 1) / 2});
  std::size_t from = 0;
  for (std::int64_t a = 0; a < below.dims[0]; ++a) {
    for (std::int64_t b = 0; b < below.dims[1]; ++b) {
      const auto row = static_cast<std::size_t>((a / 2 * above.dims[1] + b / 2) * above.dims[2]);
      for (std::int64_t c = 0; c < below.dims[2]; ++c, ++from) {
        const std::size_t to = row + static_cast<std::size_t>(c / 2);
        above.min[to] = std::min(above.min[to], below.min[from]);
        above.max[to] = std::max(above.max[to], below.max[from]);
        above.has_null[to] |= below.has_null[from];
      }
    }
  }
  return above;
}

// One row (a, b) of leaves; `least` and `greatest` are room for a row of samples.
void fold_leaves(const Field& volume, const survey::Index& leaf_cells, std::int64_t a, std::int64_t b,
                 BrickRanges& into) {
  const auto size = static_cast<std::size_t>(volume.size[2]);
  std::vector<float> least(size, kInf);
  std::vector<float> greatest(size, -kInf);
  std::vector<std::uint8_t> null(size, 0);
  const auto last = [&](int axis, std::int64_t n) {
    return std::min((n + 1) * leaf_cells[axis], volume.size[axis] - 1);
  };
  for (std::int64_t i = a * leaf_cells[0]; i <= last(0, a); ++i) {
    for (std::int64_t j = b * leaf_cells[1]; j <= last(1, b); ++j) {
      const float* const row = volume.values.data() + (i * volume.size[1] + j) * volume.size[2];
      for (std::size_t k = 0; k < size; ++k) {
        // Comparisons are false for nulls.
        least[k] = row[k] < least[k] ? row[k] : least[k];
        greatest[k] = row[k] > greatest[k] ? row[k] : greatest[k];
        null[k] |= row[k] != row[k] ? 1 : 0;
      }
    }
  }
  for (std::int64_t c = 0; c < into.dims[2]; ++c) {
    const auto leaf = static_cast<std::size_t>((a * into.dims[1] + b) * into.dims[2] + c);
    for (std::int64_t k = c * leaf_cells[2]; k <= last(2, c); ++k) {
      const auto at = static_cast<std::size_t>(k);
      into.min[leaf] = std::min(into.min[leaf], least[at]);
      into.max[leaf] = std::max(into.max[leaf], greatest[at]);
      into.has_null[leaf] |= null[at];
    }
  }
}

}  // namespace

Viewpoint viewpoint_of(const render::Camera& camera, const render::Placement& placement) {
  const std::array<double, 9>& m = placement.linear;
  const survey::Vector3 rows[] = {{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}};
  const survey::Vector3 inverse[] = {cross(rows[1], rows[2]), cross(rows[2], rows[0]),
                                     cross(rows[0], rows[1])};  // columns, times the determinant
  const double determinant = dot(rows[0], inverse[0]);
  const survey::Vector3 seen = camera.perspective ? camera.eye - placement.shift : camera.forward;
  const survey::Vector3 place =
      (inverse[0] * seen.x + inverse[1] * seen.y + inverse[2] * seen.z) * (1 / determinant);
  if (!std::isfinite(place.x) || !std::isfinite(place.y) || !std::isfinite(place.z)) {
    throw Error(ErrorCode::kInvalid, "a surface's map to the scene is singular or not finite");
  }
  return {place, camera.perspective};
}

BrickRanges leaf_ranges(const Field& volume, const survey::Index& leaf_cells, int threads) {
  if (volume.size != volume.volume_size || !are_positive(volume.size)) {
    throw Error(ErrorCode::kInvalid, "leaves are made of a whole volume");
  }
  if (!are_positive(leaf_cells)) throw Error(ErrorCode::kInvalid, "a leaf has at least one cell each way");
  BrickRanges ranges = empty_ranges(leaves_of(volume.size, leaf_cells));
  detail::for_each_in_parallel(ranges.dims[0] * ranges.dims[1], threads, [&](std::int64_t row, int) {
    fold_leaves(volume, leaf_cells, row / ranges.dims[1], row % ranges.dims[1], ranges);
  });
  return ranges;
}

Octree::Octree(const Bricks& leaves, const survey::Index& volume_size, const survey::Index& leaf_cells)
    : volume_size_(volume_size), leaf_cells_(leaf_cells) {
  const auto count = static_cast<std::size_t>(leaves.dims[0] * leaves.dims[1] * leaves.dims[2]);
  if (!are_positive(volume_size) || !are_positive(leaf_cells) ||
      leaves.dims != leaves_of(volume_size, leaf_cells) || leaves.min.size() != count ||
      leaves.max.size() != count || leaves.has_null.size() != count) {
    throw Error(ErrorCode::kInvalid, "an octree's leaves do not fit the volume");
  }
  BrickRanges level;
  level.dims = leaves.dims;
  level.min.assign(leaves.min.begin(), leaves.min.end());
  level.max.assign(leaves.max.begin(), leaves.max.end());
  level.has_null.assign(leaves.has_null.begin(), leaves.has_null.end());
  levels_.push_back(std::move(level));
  while (levels_.back().min.size() > 1) levels_.push_back(level_above(levels_.back()));
}

survey::Box Octree::cells_of(const Node& node) const {
  survey::Box cells;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t size = leaf_cells_[axis] << node.level;
    cells.lo[axis] = std::min(node.at[axis] * size, volume_size_[axis] - 1);
    cells.hi[axis] = std::min((node.at[axis] + 1) * size, volume_size_[axis] - 1);
  }
  return cells;
}

unsigned Octree::nearest_child(const Viewpoint& from, const Node& node) const {
  const std::array<double, 3> place{from.place.x, from.place.y, from.place.z};
  unsigned nearest = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const auto middle =
        static_cast<double>((2 * node.at[axis] + 1) * (leaf_cells_[axis] << (node.level - 1)));
    const bool is_upper = from.perspective ? place[axis] >= middle : place[axis] < 0;
    nearest |= is_upper ? 1U << axis : 0U;
  }
  return nearest;
}

std::vector<survey::Index> Octree::active(const Viewpoint& from, float isovalue, int level) const {
  std::vector<survey::Index> found;
  front_to_back(from, isovalue, [&](const Node& node) {
    if (node.level > level) return true;
    found.push_back(node.at);
    return false;
  });
  return found;
}

}  // namespace footwall::isosurface
