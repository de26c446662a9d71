#include "engine/voxelize/detail/lines.h"

#include <algorithm>
#include <cstdlib>

namespace footwall::voxelize::detail {
namespace {

constexpr std::int64_t kHalfVoxel = survey::kLatticePerVoxel / 2;
constexpr std::int64_t kReach = std::int64_t{1} << 30;

// The half-plane a X + b Y + k >= 0 of lattice positions, with b != 0, met by squares of half-width
// kHalfVoxel.
Line bound_from(std::int64_t a, std::int64_t b, Int128 k) {
  const Int128 reach = k + kHalfVoxel * static_cast<Int128>(std::abs(a) + std::abs(b));
  // 256 (a x + b y) >= -reach is a x + b y >= -floor(reach / 256) for integers.
  const auto c = static_cast<std::int64_t>(reach >> 8);
  if (b < 0) return {true, a, c, -b};
  return {false, -a, b - 1 - c, b};  // ceil(n / b) = floor((n + b - 1) / b)
}

}  // namespace

Corners corners_of(const survey::LatticeTriangle& triangle) {
  Corners corners;
  for (int n = 0; n < 3; ++n) corners[n] = {triangle[n].i, triangle[n].j, triangle[n].k};
  return corners;
}

Lines edge_bounds(const Corners& corners, int x_axis, int y_axis) {
  const auto edge = [&](int from, int axis) { return corners[(from + 1) % 3][axis] - corners[from][axis]; };
  const Int128 area = static_cast<Int128>(edge(0, x_axis)) * edge(1, y_axis) -
                      static_cast<Int128>(edge(0, y_axis)) * edge(1, x_axis);
  Lines lines;
  const auto add = [&](int from, bool flip) {
    std::int64_t a = -edge(from, y_axis);
    std::int64_t b = edge(from, x_axis);
    if (flip) {
      a = -a;
      b = -b;
    }
    if (b == 0) return;
    const Int128 k =
        -(static_cast<Int128>(a) * corners[from][x_axis] + static_cast<Int128>(b) * corners[from][y_axis]);
    lines.line[lines.size++] = bound_from(a, b, k);
  };
  if (area == 0) {
    int longest = 0;
    for (int n = 1; n < 3; ++n) {
      if (std::abs(edge(n, x_axis)) > std::abs(edge(longest, x_axis))) longest = n;
    }
    add(longest, false);
    add(longest, true);
  } else {
    for (int n = 0; n < 3; ++n) add(n, area < 0);
  }
  return lines;
}

// With e_s the error of the rounded slope (0 <= e_s < 1 unit of 2^-shift), the value is off by at most
// `reach` units within `reach` of x_mid. The base is raised by as much, so that the value is never too low,
// and too high by less than 2 reach + 1 units. The true value is a multiple of 1/d, so its floor is right if
// that is at most 1/d.
bool to_fixed(const Line& line, std::int64_t x_first, std::int64_t count, FixedLine& fixed) {
  const std::int64_t reach = count / 2 + 1;
  fixed.x_mid = x_first + count / 2;
  // |a| and d are at most 2^33, x 2^24, |c| 2^58: all of this fits 64 bits.
  const std::int64_t at_mid = line.a * fixed.x_mid + line.c;
  const std::int64_t y_ref = floor_div(at_mid, line.d);
  const std::int64_t rise = std::abs(line.a) * reach / line.d + 2;
  if (std::abs(y_ref) + rise >= kReach) return false;
  fixed.y_ref = static_cast<std::int32_t>(y_ref);
  fixed.shift = 62 - bits_of(static_cast<std::uint64_t>(rise));
  const Int128 one = static_cast<Int128>(1) << fixed.shift;
  if ((2 * reach + 1) * static_cast<Int128>(line.d) > one) return false;
  fixed.slope = static_cast<std::int64_t>(floor_div(line.a * one, Int128{line.d}));
  const Int128 rest = (at_mid - y_ref * line.d) * one;
  fixed.base = static_cast<std::int64_t>(floor_div(rest + line.d - 1, Int128{line.d})) + reach;
  return true;
}

void tighten(const Line& line, std::int64_t x_first, std::span<std::int32_t> lo, std::span<std::int32_t> hi) {
  const auto step = static_cast<std::int64_t>(floor_div(line.a, line.d));
  const std::int64_t step_rest = line.a - step * line.d;
  const Int128 first = static_cast<Int128>(line.a) * x_first + line.c;
  auto value = static_cast<std::int64_t>(floor_div(first, Int128{line.d}));
  auto rest = static_cast<std::int64_t>(first - static_cast<Int128>(value) * line.d);
  for (std::size_t n = 0; n < lo.size(); ++n) {
    const auto bound = static_cast<std::int32_t>(std::clamp(value, -kReach, kReach));
    if (line.upper) {
      hi[n] = std::min(hi[n], bound);
    } else {
      lo[n] = std::max(lo[n], bound);
    }
    value += step;
    rest += step_rest;
    if (rest >= line.d) {
      rest -= line.d;
      ++value;
    }
  }
}

}  // namespace footwall::voxelize::detail
