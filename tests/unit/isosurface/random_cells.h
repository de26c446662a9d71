// Cells with random values, among them many that are hard to decide.
#pragma once
#include <array>
#include <random>

#include "engine/isosurface/case_tables.h"
#include "engine/verify/trilinear_level_set.h"

namespace footwall::isosurface {

using Values = std::array<float, 8>;

inline unsigned signs_of(const Values& values, float isovalue = 0) {
  unsigned signs = 0;
  for (unsigned c = 0; c < 8; ++c) signs |= values[c] >= isovalue ? 1U << c : 0U;
  return signs;
}

// Whole numbers within +-1024, so that the sampled level set is exact: now all of one size, now of very
// different sizes (tunnels are more frequent then), now small (so that many are 0, and many saddles too).
inline Values random_values(unsigned signs, std::mt19937_64& random) {
  const auto below = [&](unsigned bound) { return static_cast<unsigned>(random() % bound); };
  const unsigned most = 1 + below(10);
  const bool mixed = below(2) == 0;
  Values values{};
  for (unsigned c = 0; c < 8; ++c) {
    const unsigned size = mixed ? below(1U << (1 + below(most))) : below(1U << most);
    values[c] = (signs >> c & 1U) != 0 ? static_cast<float>(size) : -1 - static_cast<float>(size);
  }
  return values;
}

// What an alternative says about the parts above and below the isovalue, and the surface's Euler number.
inline verify::LevelSet meaning(unsigned signs, Alternative alternative) {
  std::array<unsigned, 8> part{0, 1, 2, 3, 4, 5, 6, 7};
  const auto unite = [&](unsigned a, unsigned b) {
    const unsigned from = part[a];
    for (unsigned& each : part) each = each == from ? part[b] : each;
  };
  const auto above = [&](unsigned c) { return (signs >> c & 1U) != 0; };
  for (unsigned axis = 0; axis < 3; ++axis) {
    const unsigned u = axis == 0 ? 2 : 1;
    const unsigned w = axis == 2 ? 2 : 4;
    for (unsigned c = 0; c < 8; ++c) {
      if ((c >> axis & 1U) == 0 && above(c) == above(c | 1U << axis)) unite(c, c | 1U << axis);
    }
    for (unsigned side = 0; side < 2; ++side) {
      const unsigned face = 2 * axis + side;
      if ((tables::kAmbiguousFaces[signs] >> face & 1U) == 0) continue;
      const unsigned a = side << axis;
      if (above(a) == ((alternative >> face & 1U) != 0)) {
        unite(a, a | u | w);
      } else {
        unite(a | u, a | w);
      }
    }
  }
  verify::LevelSet level;
  for (unsigned c = 0; c < 8; ++c) {
    if (part[c] == c) ++(above(c) ? level.inside : level.outside);
  }
  // On the surface of the cell the parts and the loops between them form a tree.
  const int loops = level.inside + level.outside - 1;
  const bool joins_above = (alternative & kTunnelAbove) != 0;
  const bool joins_below = (alternative & kTunnelBelow) != 0;
  level.euler = loops - (joins_above || joins_below ? 2 : 0);
  level.inside -= joins_above ? 1 : 0;
  level.outside -= joins_below ? 1 : 0;
  return level;
}

}  // namespace footwall::isosurface
