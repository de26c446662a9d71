#include "engine/verify/raster_by_definition.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <set>
#include <utility>

namespace footwall::verify {
namespace {

__extension__ typedef __int128 Int128;
using Real = long double;
using Pixel = std::pair<std::int64_t, std::int64_t>;
using Corner = std::array<std::int64_t, 3>;
using Matrix = std::array<Position, 3>;

constexpr Real kDoubt = 1e-5L;

Corner corner(const survey::LatticePoint& p) {
  return {p.i, p.j, p.k};
}

Position minus(const Position& a, const Position& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Real dot(const Position& a, const Position& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Real norm(const Position& a) {
  return std::sqrt(dot(a, a));
}

// E.18 for the unit quaternion of a rotation by `angle` around `axis`.
Matrix rotation(Position axis, Real angle) {
  const Real length = norm(axis);
  const Real s = std::cos(angle / 2);
  for (Real& each : axis) each *= std::sin(angle / 2) / length;
  const auto [x, y, z] = axis;
  return {Position{s * s + x * x - y * y - z * z, 2 * x * y - 2 * s * z, 2 * s * y + 2 * x * z},
          Position{2 * s * z + 2 * x * y, s * s - x * x + y * y - z * z, 2 * y * z - 2 * s * x},
          Position{2 * x * z - 2 * s * y, 2 * s * x + 2 * y * z, s * s - x * x - y * y + z * z}};
}

Position operator*(const Matrix& m, const Position& p) {
  return {dot(m[0], p), dot(m[1], p), dot(m[2], p)};
}

// Of a rotation, which is its inverse.
Matrix transposed(const Matrix& m) {
  Matrix t;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) t[c][r] = m[r][c];
  }
  return t;
}

Real angle_between(const Position& a, const Position& b) {
  return std::acos(std::clamp(dot(a, b) / (norm(a) * norm(b)), Real{-1}, Real{1}));
}

// Bresenham's pixels in closed form: the minor coordinate nearest to the line, the earlier one of two.
std::set<Pixel> line(Pixel from, Pixel to) {
  const std::int64_t dx = std::abs(to.first - from.first);
  const std::int64_t dy = std::abs(to.second - from.second);
  const bool steep = dy > dx;
  const std::int64_t run = std::max(dx, dy);
  const std::int64_t rise = std::min(dx, dy);
  std::set<Pixel> pixels;
  for (std::int64_t n = 0; n <= run; ++n) {
    // The least r with n rise / run <= r + 1/2.
    const std::int64_t risen = run == 0 ? 0 : std::max<std::int64_t>(0, (2 * rise * n + run - 1) / (2 * run));
    const std::int64_t along_x = steep ? risen : n;
    const std::int64_t along_y = steep ? n : risen;
    pixels.insert({from.first + (to.first < from.first ? -along_x : along_x),
                   from.second + (to.second < from.second ? -along_y : along_y)});
  }
  return pixels;
}

survey::Box bounding_voxels(const survey::LatticeTriangle& triangle) {
  survey::Box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [least, most] =
        std::minmax({corner(triangle[0])[axis], corner(triangle[1])[axis], corner(triangle[2])[axis]});
    // Voxel m reaches from 256 m - 128 to 256 m + 128, both included.
    box.lo[axis] = static_cast<std::int64_t>(std::ceil((static_cast<Real>(least) - 128) / 256));
    box.hi[axis] = static_cast<std::int64_t>(std::floor((static_cast<Real>(most) + 128) / 256)) + 1;
  }
  return box;
}

std::int64_t pixel_of(Real x, bool& doubtful) {
  const Real whole = std::nearbyint(x);
  if (std::abs(std::abs(x - whole) - 0.5L) < kDoubt) doubtful = true;
  return static_cast<std::int64_t>(whole);
}

}  // namespace

RotatedPixels rotated_by_formulas(const survey::LatticeTriangle& triangle) {
  RotatedPixels result;
  // The longest edge, and its end nearest the origin, in exact integers.
  const auto squared = [](const Corner& a, const Corner& b) {
    Int128 sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      sum += static_cast<Int128>(a[axis] - b[axis]) * (a[axis] - b[axis]);
    return sum;
  };
  std::array<Corner, 3> p = {corner(triangle[0]), corner(triangle[1]), corner(triangle[2])};
  const Int128 edges[] = {squared(p[0], p[1]), squared(p[1], p[2]), squared(p[2], p[0])};
  const auto longest = static_cast<std::size_t>(std::max_element(edges, edges + 3) - edges);
  Corner c1 = p[longest];
  Corner c3 = p[(longest + 1) % 3];
  const Corner c2 = p[(longest + 2) % 3];
  if (squared(c3, {0, 0, 0}) < squared(c1, {0, 0, 0})) std::swap(c1, c3);
  const auto in_voxels = [](const Corner& c) {
    return Position{static_cast<Real>(c[0]) / 256, static_cast<Real>(c[1]) / 256,
                    static_cast<Real>(c[2]) / 256};
  };
  const Position translation = in_voxels(c1);
  Position v2 = minus(in_voxels(c2), translation);
  Position v3 = minus(in_voxels(c3), translation);
  if (norm(v3) == 0) return result;

  // (3.36) to (3.41)
  const bool upright = v3[0] == 0 && v3[1] == 0;
  const Real alpha = upright ? std::numbers::pi_v<Real> / 2 : angle_between(v3, {v3[0], v3[1], 0});
  const Matrix r1 =
      rotation(upright ? Position{0, 1, 0} : Position{-v3[1], v3[0], 0}, v3[2] >= 0 ? alpha : -alpha);
  v2 = r1 * v2;
  v3 = r1 * v3;
  // (3.42) to (3.44)
  const Real beta = angle_between(v3, {1, 0, 0});
  const Matrix r2 = rotation({0, 0, 1}, v3[1] >= 0 ? -beta : beta);
  v2 = r2 * v2;
  v3 = r2 * v3;
  // (3.45) to (3.47); where y is 0 the projection has no direction, and the angle is a right one.
  if (std::abs(v2[1]) < 1e-9L && std::abs(v2[2]) < 1e-9L) return result;
  const Real gamma = std::acos(std::abs(v2[1]) / std::hypot(v2[1], v2[2]));
  const bool same = (v2[1] >= 0 && v2[2] >= 0) || (v2[1] < 0 && v2[2] < 0);
  const Matrix r3 = rotation({1, 0, 0}, same ? -gamma : gamma);
  v2 = r3 * v2;
  const Real side = v2[1] < 0 ? -1 : 1;

  const std::int64_t x3 = pixel_of(v3[0], result.doubtful);
  const std::int64_t x2 = std::clamp<std::int64_t>(pixel_of(v2[0], result.doubtful), 0, x3);
  const std::int64_t y2 = pixel_of(side * v2[1], result.doubtful);
  const std::set<Pixel> l1 = line({0, 0}, {x2, y2});
  const std::set<Pixel> l2 = line({x2, y2}, {x3, 0});
  for (std::int64_t x = 0; x <= x3; ++x) {
    for (std::int64_t y = 0; y <= y2; ++y) {
      if (l1.contains({x, y}) || l2.contains({x, y})) break;
      const Position pixel = {static_cast<Real>(x), side * static_cast<Real>(y), 0};
      const Position turned = transposed(r1) * (transposed(r2) * (transposed(r3) * pixel));
      result.position.push_back(
          {turned[0] + translation[0], turned[1] + translation[1], turned[2] + translation[2]});
    }
  }
  return result;
}

bool are_rounded(const RotatedPixels& pixels, const std::vector<std::array<std::int32_t, 3>>& voxels,
                 const survey::LatticeTriangle& triangle) {
  const survey::Box bounds = bounding_voxels(triangle);
  std::size_t next = 0;
  for (const Position& at : pixels.position) {
    const auto near = [&](const std::array<std::int32_t, 3>& voxel) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (std::abs(at[axis] - voxel[axis]) > 0.5L + kDoubt) return false;
      }
      return true;
    };
    if (next < voxels.size() && near(voxels[next])) {
      ++next;
      continue;
    }
    // Left out: at least on the very edge of the bounding box.
    bool at_the_edge = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (at[axis] < static_cast<Real>(bounds.lo[axis]) - 0.5L + kDoubt ||
          at[axis] > static_cast<Real>(bounds.hi[axis]) - 0.5L - kDoubt)
        at_the_edge = true;
    }
    if (!at_the_edge) return false;
  }
  return next == voxels.size() &&
         std::all_of(voxels.begin(), voxels.end(), [&](const std::array<std::int32_t, 3>& voxel) {
           return bounds.contains({voxel[0], voxel[1], voxel[2]});
         });
}

std::vector<survey::Index> kaufman_by_definition(const survey::LatticeTriangle& triangle,
                                                 const survey::Box& box) {
  const std::array<Corner, 3> p = {corner(triangle[0]), corner(triangle[1]), corner(triangle[2])};
  std::array<Int128, 3> normal;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t b = (axis + 1) % 3;
    const std::size_t c = (axis + 2) % 3;
    normal[axis] = static_cast<Int128>(p[1][b] - p[0][b]) * (p[2][c] - p[0][c]) -
                   static_cast<Int128>(p[1][c] - p[0][c]) * (p[2][b] - p[0][b]);
  }
  const auto size = [&](std::size_t axis) { return normal[axis] < 0 ? -normal[axis] : normal[axis]; };
  const std::size_t w = size(0) >= size(1) && size(0) >= size(2) ? 0 : size(1) >= size(2) ? 1 : 2;
  const std::size_t u = w == 2 ? 1 : 2;
  const std::size_t v = 3 - u - w;
  if (normal[w] < 0) {
    for (Int128& each : normal) each = -each;
  }
  const auto rounded = [](std::int64_t lattice) {
    return static_cast<std::int64_t>(std::floor(static_cast<Real>(lattice) / 256 + 0.5L));
  };
  std::map<std::int64_t, std::set<std::int64_t>> edges;  // the u of a row's edge pixels
  for (std::size_t n = 0; n < 3; ++n) {
    const Corner& a = p[n];
    const Corner& b = p[(n + 1) % 3];
    for (const Pixel& pixel : line({rounded(a[u]), rounded(a[v])}, {rounded(b[u]), rounded(b[v])}))
      edges[pixel.second].insert(pixel.first);
  }
  const Int128 at_corner = normal[0] * p[0][0] + normal[1] * p[0][1] + normal[2] * p[0][2];

  const survey::Box inside = survey::intersection(box, bounding_voxels(triangle));
  std::vector<survey::Index> voxels;
  for (std::int64_t i = inside.lo[0]; i < inside.hi[0]; ++i) {
    for (std::int64_t j = inside.lo[1]; j < inside.hi[1]; ++j) {
      for (std::int64_t k = inside.lo[2]; k < inside.hi[2]; ++k) {
        const survey::Index voxel = {i, j, k};
        const auto row = edges.find(voxel[v]);
        if (row == edges.end()) continue;
        const bool between = *row->second.begin() <= voxel[u] && voxel[u] <= *row->second.rbegin();
        // Above the plane by at most half a voxel, or below by less.
        const Int128 below = at_corner - 256 * (normal[0] * i + normal[1] * j + normal[2] * k);
        const bool nearest = below >= -128 * normal[w] && below < 128 * normal[w];
        if (between && nearest) voxels.push_back(voxel);
      }
    }
  }
  return voxels;
}

}  // namespace footwall::verify
