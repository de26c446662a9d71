#include "engine/extract/cost/cover.h"

#include <algorithm>

namespace footwall::extract {
namespace {

constexpr double kPerVoxel = survey::kLatticePerVoxel;

double magnitude(double value) {
  return value < 0 ? -value : value;
}

}  // namespace

Shape shape_of(const survey::LatticeTriangle& t) {
  const auto at = [&](std::size_t n) {
    return std::array<double, 3>{static_cast<double>(t[n].i) / kPerVoxel,
                                 static_cast<double>(t[n].j) / kPerVoxel,
                                 static_cast<double>(t[n].k) / kPerVoxel};
  };
  const std::array<double, 3> a = at(0);
  const std::array<double, 3> b = at(1);
  const std::array<double, 3> c = at(2);
  Shape shape;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    shape.area[axis] = magnitude((b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u])) / 2;
    shape.side[axis] = std::max({a[axis], b[axis], c[axis]}) - std::min({a[axis], b[axis], c[axis]});
  }
  return shape;
}

double expected_cover(const Shape& shape, const std::array<double, 3>& block) {
  double sum = block[0] * block[1] * block[2];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    sum += block[u] * block[v] * shape.side[axis] + block[axis] * shape.area[axis];
  }
  return sum;
}

double expected_bounding(const Shape& shape) {
  // A box of sides e meets e + 1 voxels along an axis, on average.
  return (shape.side[0] + 1) * (shape.side[1] + 1) * (shape.side[2] + 1);
}

}  // namespace footwall::extract
