#include "engine/extract/fault_side.h"

namespace footwall::extract {

std::array<Int128, 3> exact_normal(const survey::LatticeTriangle& t) {
  const auto edge = [&](std::size_t to) {
    return std::array<Int128, 3>{Int128{t[to].i} - t[0].i, Int128{t[to].j} - t[0].j,
                                 Int128{t[to].k} - t[0].k};
  };
  const auto a = edge(1);
  const auto b = edge(2);
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

int side_of(const std::array<Int128, 3>& sum) {
  for (const Int128 component : sum) {
    if (component != 0) return component > 0 ? 1 : -1;
  }
  return 1;
}

int fault_side(std::span<const survey::LatticeTriangle> faces) {
  std::array<Int128, 3> sum{};
  for (const survey::LatticeTriangle& face : faces) {
    const auto normal = exact_normal(face);
    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += normal[axis];
  }
  return side_of(sum);
}

}  // namespace footwall::extract
