// Based on: Nielson and Hamann, The asymptotic decider, 1991, without its division. The interior: the slices
// of the cell along k are bilinear, of corners that change linearly, and p r - q s, whose sign says which of
// a slice's diagonals are joined, is a quadratic along k. A tunnel is where it has both of its zeros inside
// the cell, in slices whose diagonals have opposite signs (docs/isosurface-cases.md).
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/isosurface/case_tables.h"
#include "engine/isosurface/detail/wide_integer.h"

namespace footwall::isosurface {
namespace {

// A double, and how far it may be from the number it stands for.
struct Bounded {
  static constexpr double kRounding = 0x1p-53;
  double value = 0;
  double error = 0;

  static Bounded rounded(double value, double error) { return {value, error + kRounding * std::abs(value)}; }
  friend Bounded operator+(const Bounded& a, const Bounded& b) {
    return rounded(a.value + b.value, a.error + b.error);
  }
  friend Bounded operator-(const Bounded& a, const Bounded& b) {
    return rounded(a.value - b.value, a.error + b.error);
  }
  friend Bounded operator*(const Bounded& a, const Bounded& b) {
    return rounded(a.value * b.value,
                   std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error);
  }
  // 0: cannot tell. The errors' own rounding is far below the margin.
  int sign() const {
    if (std::abs(value) <= 1.0000001 * error) return 0;
    return value > 0 ? 1 : -1;
  }
};

// The corners' values relative to the isovalue, as doubles first.
class Corners {
 public:
  Corners(const std::array<float, 8>& values, float isovalue) : isovalue_(isovalue) {
    for (std::size_t c = 0; c < 8; ++c) {
      constexpr float kMost = std::numeric_limits<float>::max();
      values_[c] = std::clamp(values[c], -kMost, kMost);
      bounded_[c] = Bounded::rounded(static_cast<double>(values_[c]) - static_cast<double>(isovalue), 0);
    }
  }

  // The sign of a polynomial of the eight corners, of degree four at most.
  template <class Polynomial>
  int sign(const Polynomial& polynomial) {
    const int near = polynomial(bounded_).sign();
    if (near != 0) return near;
    if (!exact_) {
      exact_.emplace();
      for (std::size_t c = 0; c < 8; ++c) (*exact_)[c] = WideInteger(values_[c]) - WideInteger(isovalue_);
    }
    return polynomial(*exact_).sign();
  }

 private:
  std::array<float, 8> values_{};
  float isovalue_;
  std::array<Bounded, 8> bounded_{};
  std::optional<std::array<WideInteger, 8>> exact_;
};

constexpr bool is_above(unsigned signs, int corner) {
  return (signs >> corner & 1U) != 0;
}

unsigned joined_faces(unsigned signs, Corners& corners) {
  unsigned joined = 0;
  for (int face = 0; face < 6; ++face) {
    if ((tables::kAmbiguousFaces[signs] >> face & 1) == 0) continue;
    const int axis = face / 2;
    const int u = axis == 0 ? 2 : 1;
    const int w = axis == 2 ? 2 : 4;
    const int a = (face & 1) << axis;
    const int saddle = corners.sign([&](const auto& v) { return v[a] * v[a | u | w] - v[a | u] * v[a | w]; });
    if (is_above(signs, a) ? saddle >= 0 : saddle <= 0) joined |= 1U << face;
  }
  return joined;
}

// Lines along k from the corners p, r, q and s of the face k = 0, p across from r; the tunnel is to join what
// p and r have, above the isovalue or below.
class Passage {
 public:
  Passage(unsigned signs, Corners& corners, const std::array<int, 4>& lines, bool above)
      : signs_(signs), corners_(corners), lines_(lines), above_(above) {}

  // With x = p r - q s at k = 0, y at k = 1 and m their mixed term, a slice at k has
  // x (1 - k)^2 + m k (1 - k) + y k^2: negative at both ends, positive between.
  bool is_open() const {
    if (!is_parted(corners_.sign([&](const auto& v) { return low(v); }))) return false;
    if (!is_parted(corners_.sign([&](const auto& v) { return high(v); }))) return false;
    if (corners_.sign([&](const auto& v) { return mixed(v); }) <= 0) return false;
    const int zeros = corners_.sign([&](const auto& v) {
      const auto m = mixed(v);
      return m * m - four(low(v) * high(v));
    });
    if (above_ ? zeros < 0 : zeros <= 0) return false;
    return stays(lines_[0], above_) && stays(lines_[1], above_) && stays(lines_[2], !above_) &&
           stays(lines_[3], !above_);
  }

 private:
  // A saddle at the isovalue joins what is above it.
  bool is_parted(int sign) const { return above_ ? sign < 0 : sign <= 0; }

  template <class Number>
  static Number four(const Number& number) {
    const Number two = number + number;
    return two + two;
  }
  template <class Values>
  auto low(const Values& v) const {
    const auto [p, r, q, s] = lines_;
    return v[p] * v[r] - v[q] * v[s];
  }
  template <class Values>
  auto high(const Values& v) const {
    const auto [p, r, q, s] = lines_;
    return v[p | 4] * v[r | 4] - v[q | 4] * v[s | 4];
  }
  template <class Values>
  auto mixed(const Values& v) const {
    const auto [p, r, q, s] = lines_;
    return v[p] * v[r | 4] + v[p | 4] * v[r] - v[q] * v[s | 4] - v[q | 4] * v[s];
  }

  // Whether the line is above (below) the isovalue in the slices of both zeros. Where it crosses the
  // isovalue the quadratic must still be negative, and on the right side of the greatest slice.
  bool stays(int line, bool above) const {
    const bool at_low = is_above(signs_, line) == above;
    const bool at_high = is_above(signs_, line | 4) == above;
    if (at_low == at_high) return at_low;
    const int crossing = corners_.sign([&](const auto& v) {
      const auto& a = v[line];
      const auto& b = v[line | 4];
      return high(v) * a * a - mixed(v) * a * b + low(v) * b * b;
    });
    if (!is_parted(crossing)) return false;
    const int side =
        corners_.sign([&](const auto& v) { return (high(v) + high(v)) * v[line] - mixed(v) * v[line | 4]; });
    return above ? side < 0 : side >= 0;  // 0: a value at the isovalue, which counts as just above
  }

  unsigned signs_;
  Corners& corners_;
  std::array<int, 4> lines_;
  bool above_;
};

bool has_tunnel(unsigned signs, Corners& corners, bool above) {
  return Passage(signs, corners, {0, 3, 1, 2}, above).is_open() ||
         Passage(signs, corners, {1, 2, 0, 3}, above).is_open();
}

}  // namespace

Alternative decide(unsigned signs, const std::array<float, 8>& values, float isovalue) {
  if (!is_undecided(signs)) return 0;
  Corners corners(values, isovalue);
  const auto faces = static_cast<Alternative>(joined_faces(signs, corners));
  if (has_pattern(signs, faces | kTunnelAbove) && has_tunnel(signs, corners, true))
    return faces | kTunnelAbove;
  if (has_pattern(signs, faces | kTunnelBelow) && has_tunnel(signs, corners, false))
    return faces | kTunnelBelow;
  return faces;
}

}  // namespace footwall::isosurface
