#include "engine/render/lit_surface.h"

#include <fmt/format.h>

#include <cmath>

#include "storage/base/error.h"

namespace footwall::render {
namespace {

std::array<double, 9> cofactors(const std::array<double, 9>& m) {
  const auto minor = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
    return m[a] * m[d] - m[b] * m[c];
  };
  return {minor(4, 5, 7, 8),  -minor(3, 5, 6, 8), minor(3, 4, 6, 7),  -minor(1, 2, 7, 8), minor(0, 2, 6, 8),
          -minor(0, 1, 6, 7), minor(1, 2, 4, 5),  -minor(0, 2, 3, 5), minor(0, 1, 3, 4)};
}

double determinant(const std::array<double, 9>& m) {
  const std::array<double, 9> c = cofactors(m);
  return m[0] * c[0] + m[1] * c[1] + m[2] * c[2];
}

}  // namespace

bool Placement::mirrors() const {
  return determinant(linear) < 0;
}

Matrix4 Placement::then(const Matrix4& view_projection) const {
  Matrix4 both{};
  for (std::size_t row = 0; row < 4; ++row) {
    const double* m = &view_projection[4 * row];
    for (std::size_t column = 0; column < 3; ++column) {
      both[4 * row + column] = m[0] * linear[column] + m[1] * linear[3 + column] + m[2] * linear[6 + column];
    }
    both[4 * row + 3] = m[0] * shift.x + m[1] * shift.y + m[2] * shift.z + m[3];
  }
  return both;
}

std::array<float, 9> normals_to_view(const Placement& placement, const Camera& camera) {
  // The inverse transpose is the cofactors over the determinant; of that only the sign matters to a
  // direction.
  const std::array<double, 9> c = cofactors(placement.linear);
  const double sign = placement.mirrors() ? -1 : 1;
  const Vec3 axes[] = {camera.right, camera.up, camera.forward * -1};
  double largest = 0;
  std::array<double, 9> m{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      const double v = axes[row].x * c[column] + axes[row].y * c[3 + column] + axes[row].z * c[6 + column];
      m[3 * row + column] = sign * v;
      largest = std::max(largest, std::abs(v));
    }
  }
  // Near 1, so that squares of normals fit in a float.
  std::array<float, 9> to_view{};
  for (std::size_t n = 0; n < 9; ++n) to_view[n] = static_cast<float>(m[n] / largest);
  return to_view;
}

void check(const LitSurface& surface) {
  if (surface.normals.size() != surface.positions.size()) {
    throw Error(ErrorCode::kInvalid, fmt::format("a surface of {} vertices has {} normals",
                                                 surface.positions.size(), surface.normals.size()));
  }
  check_indices(surface.triangles, surface.positions.size());
  const double volume = determinant(surface.placement.linear);
  if (!std::isfinite(1 / volume) || !std::isfinite(volume)) {
    throw Error(ErrorCode::kInvalid, "a surface's map to the scene is singular or not finite");
  }
  if (surface.runs.empty() ? !surface.triangles.empty() : surface.runs.front().first_triangle != 0)
    throw Error(ErrorCode::kInvalid, "a surface's triangles are not all numbered");
  for (std::size_t n = 1; n < surface.runs.size(); ++n) {
    const IdRun& before = surface.runs[n - 1];
    const IdRun& run = surface.runs[n];
    if (run.first_triangle > before.first_triangle && run.first_id >= before.first_id &&
        run.first_id - before.first_id >= run.first_triangle - before.first_triangle)
      continue;
    throw Error(ErrorCode::kInvalid, fmt::format("run {} of a surface's numbers is out of order", n));
  }
}

}  // namespace footwall::render
