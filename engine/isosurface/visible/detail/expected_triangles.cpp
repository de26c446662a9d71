#include "engine/isosurface/visible/detail/expected_triangles.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace footwall::isosurface::detail {
namespace {

constexpr float kTrianglesAnEdge = 8.0F / 9;
// Pixels squared: of triangles whose plane comes out so wide, seen from where it is narrowest, 7 of 10 meet
// centres. Measured, on surfaces of many
// kinds.
constexpr float kNarrow = 0.8F;

// Bit 9 i + 3 j + k stands for a part's sample (i, j, k); those from which an edge goes on along an axis.
constexpr unsigned kPlanes = 1U | 1U << 9U | 1U << 18U;
constexpr std::array<unsigned, 3> kWithEdge{(1U << 18U) - 1, kPlanes * 0b000111111U, kPlanes * 0b011011011U};
constexpr std::array<unsigned, 3> kNext{9, 3, 1};

}  // namespace

struct ExpectedTriangles::Part {
  Part(const Field& field, const survey::Index& first, float isovalue) {
    // Beyond the volume as its last sample: nothing is cut there.
    survey::Index last{};
    for (int axis = 0; axis < 3; ++axis)
      last[axis] = std::min<std::int64_t>(2, field.volume_size[axis] - 1 - first[axis]);
    const float* const corner =
        field.values.data() +
        ((first[0] - field.origin[0]) * field.size[1] + first[1] - field.origin[1]) * field.size[2] +
        first[2] - field.origin[2];
    unsigned n = 0;
    for (std::int64_t i = 0; i < 3; ++i) {
      for (std::int64_t j = 0; j < 3; ++j) {
        const float* const row =
            corner + (std::min(i, last[0]) * field.size[1] + std::min(j, last[1])) * field.size[2];
        for (std::int64_t k = 0; k < 3; ++k, ++n) {
          values[n] = row[std::min(k, last[2])];
          inside |= (values[n] >= isovalue ? 1U : 0U) << n;
        }
      }
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
      cut[axis] = (inside ^ inside >> kNext[axis]) & kWithEdge[axis];
  }

  // Of the trilinear field between its corners, at their middle; of any length.
  std::array<float, 3> gradient() const {
    std::array<float, 3> sum{};
    for (unsigned n = 0; n < 8; ++n) {
      const float value = values[18 * (n >> 2U) + 6 * (n >> 1U & 1U) + 2 * (n & 1U)];
      sum[0] += (n & 4U) != 0 ? value : -value;
      sum[1] += (n & 2U) != 0 ? value : -value;
      sum[2] += (n & 1U) != 0 ? value : -value;
    }
    return sum;
  }

  std::array<float, 27> values{};
  unsigned inside = 0;
  std::array<unsigned, 3> cut{};  // edges along each axis, by their first sample
};

ExpectedTriangles::ExpectedTriangles(const VisibleRequest& request, const EarlierWaves& earlier)
    : isovalue_(request.isovalue), earlier_(earlier) {
  const render::Matrix4 to_clip = request.placement.then(request.camera.view_projection);
  for (std::size_t axis = 0; axis < 4; ++axis) {
    const double x = to_clip[axis];
    const double y = to_clip[4 + axis];
    const double z = to_clip[8 + axis];
    const double w = to_clip[12 + axis];
    const std::array<double, 4> column{(w + x) * 0.5 * request.width, (w - y) * 0.5 * request.height,
                                       (w + z) * 0.5, w};
    if (axis == 3) {
      first_ = column;
    } else {
      for (std::size_t n = 0; n < 4; ++n) steps_[axis][n] = static_cast<float>(column[n]);
    }
  }
}

ExpectedTriangles::OnScreen ExpectedTriangles::moved(const OnScreen& from, float i, float j, float k) const {
  OnScreen to;
  for (std::size_t n = 0; n < 4; ++n)
    to[n] = from[n] + i * steps_[0][n] + j * steps_[1][n] + k * steps_[2][n];
  return to;
}

std::optional<ExpectedTriangles::Slopes> ExpectedTriangles::slopes_at(const OnScreen& point) const {
  if (!(point[3] > 0)) return std::nullopt;
  Slopes slopes;
  for (std::size_t n = 0; n < 2; ++n) {
    const float place = point[n] / point[3];
    for (std::size_t axis = 0; axis < 3; ++axis)
      slopes[n][axis] = (steps_[axis][n] - place * steps_[axis][3]) / point[3];
  }
  return slopes;
}

// By how wide and how high a step of one cell within the surface comes out.
float ExpectedTriangles::share_met(const Part& part, const Slopes& slopes) {
  const std::array<float, 3> normal = part.gradient();
  const float length = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
  if (!(length > 0) || !std::isfinite(length)) return 1;
  float share = 1;
  for (std::size_t n = 0; n < 2; ++n) {
    float all = 0;
    float along_normal = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      all += slopes[n][axis] * slopes[n][axis];
      along_normal += slopes[n][axis] * normal[axis];
    }
    const float within = std::max(0.0F, all - along_normal * along_normal / length);
    share *= within / (within + kNarrow);
  }
  return std::sqrt(share);
}

// Once for its pixel, and once for those around, where they show nothing before it: a triangle is kept for
// any pixel of its box.
int ExpectedTriangles::times_seen(const OnScreen& point, std::size_t around) const {
  const render::DepthPyramid& depths = *earlier_.depths;
  const render::ScreenBox& window = depths.window();
  if (!(point[3] > 0)) return 2;
  const float x = point[0] / point[3];
  const float y = point[1] / point[3];
  if (!(x >= static_cast<float>(window.x0) && x < static_cast<float>(window.x1 + 1) &&
        y >= static_cast<float>(window.y0) && y < static_cast<float>(window.y1 + 1)))
    return 0;
  const int column = static_cast<int>(x);
  const int row = static_cast<int>(y);
  const render::CoarseDepth depth = earlier_.scale.of_box(point[2] / point[3]);
  return (depths.farthest_around(column, row, 0) > depth ? 1 : 0) +
         (depths.farthest_around(column, row, around) > depth ? 1 : 0);
}

int ExpectedTriangles::points_seen(const Part& part, const OnScreen& corner, std::size_t around) const {
  int seen = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (unsigned left = part.cut[axis]; left != 0; left &= left - 1) {
      const auto n = static_cast<unsigned>(std::countr_zero(left));
      const float a = part.values[n];
      const float b = part.values[n + kNext[axis]];
      std::array<float, 3> at{static_cast<float>(n / 9), static_cast<float>(n / 3 % 3),
                              static_cast<float>(n % 3)};
      const float share = (isovalue_ - a) / (b - a);
      if (!(share >= 0 && share <= 1)) continue;  // next to a null
      at[axis] += share;
      seen += times_seen(moved(corner, at[0], at[1], at[2]), around);
    }
  }
  return seen;
}

std::int64_t ExpectedTriangles::of(const Field& field, const survey::Index& brick, BrickParts chosen) const {
  OnScreen corner;
  for (std::size_t n = 0; n < 4; ++n) {
    double sum = first_[n];
    for (std::size_t axis = 0; axis < 3; ++axis)
      sum += 8 * static_cast<double>(brick[static_cast<int>(axis)]) * static_cast<double>(steps_[axis][n]);
    corner[n] = static_cast<float>(sum);
  }
  const std::optional<Slopes> slopes = slopes_at(moved(corner, 4, 4, 4));
  // Half a cell's size at most, and two pixels at least.
  std::size_t around = 1;
  if (slopes) {
    float most = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      most = std::max(most, std::hypot((*slopes)[0][axis], (*slopes)[1][axis]));
    around += static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(std::min(most, 256.0F) / 4)));
  }
  float triangles = 0;
  for (BrickParts left = chosen; left != 0; left &= left - 1) {
    const int bit = std::countr_zero(left);
    const survey::Index in_brick{2 * (bit >> 4), 2 * (bit >> 2 & 3), 2 * (bit & 3)};
    const Part part(field,
                    {8 * brick[0] + in_brick[0], 8 * brick[1] + in_brick[1], 8 * brick[2] + in_brick[2]},
                    isovalue_);
    const OnScreen first = moved(corner, static_cast<float>(in_brick[0]), static_cast<float>(in_brick[1]),
                                 static_cast<float>(in_brick[2]));
    const int seen = points_seen(part, first, around);
    if (seen == 0) continue;
    const float met = slopes ? share_met(part, *slopes) : 1;
    triangles += kTrianglesAnEdge * static_cast<float>(seen) / 2 * met;
  }
  return std::lround(static_cast<float>(kTriangle) * triangles);
}

}  // namespace footwall::isosurface::detail
