// The topology of the level set of a trilinear field, by its definition: the cell is halved until every part
// is either all above or all below the level, or monotone along an axis, and what the parts have in common is
// counted off. It knows no cases and no critical points. Exact where the values are whole numbers below 2^11
// (all samples are then exact in double), else within rounding.
#pragma once
#include <array>
#include <optional>
#include <span>

namespace footwall::verify {

// Values relative to the level; inside is v >= 0, and what is exactly 0 counts as if it were raised a little.
// Corner c of the cell is the sample (c & 1, c >> 1 & 1, c >> 2 & 1). Nothing if the halving does not come to
// an end: the level passes through a saddle, or nearly.
struct LevelSet {
  int euler = 0;    // Euler number of the surface, with its boundary on the faces of the cell
  int inside = 0;   // connected parts of {v >= 0} in the cell
  int outside = 0;  // and of {v < 0}
  friend bool operator==(const LevelSet&, const LevelSet&) = default;
};
std::optional<LevelSet> trilinear_level_set(const std::array<double, 8>& values);
// The Euler number alone; much faster.
std::optional<int> trilinear_euler_number(const std::array<double, 8>& values);

// Whether the two inside corners of an ambiguous face are joined on it: a and d are opposite corners.
bool face_joins_inside(double a, double b, double c, double d);

// The Euler number of the surface in a grid of n^3 samples, x + n * (y + n * z), open where it meets the
// border of the grid.
std::optional<int> grid_euler_number(std::span<const double> values, int n);

}  // namespace footwall::verify
