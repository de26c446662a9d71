#include "engine/isosurface/detail/case_lookup.h"

namespace footwall::isosurface::detail {

CaseLookup::CaseLookup() : lanes{}, signs{} {
  for (unsigned bits = 0; bits < 256; ++bits) {
    unsigned sign = 0;
    for (unsigned row = 0; row < 4; ++row) {
      for (unsigned side = 0; side < 2; ++side) {
        if ((bits >> (2 * row + side) & 1U) != 0) sign |= 1U << (row + 4 * side);
      }
    }
    signs[bits] = static_cast<std::uint8_t>(sign);
    auto& lane = lanes[bits];
    lane[kLanes - 1] = kSlow;
    if (is_undecided(sign)) continue;
    const Pattern& pattern = pattern_of(sign);
    if (pattern.has_centre || 3 * pattern.triangles.size() >= kLanes) continue;
    std::size_t at = 0;
    for (const auto& triangle : pattern.triangles) {
      for (const std::uint8_t edge : triangle) lane[at++] = kLaneOfEdge[edge];
    }
    lane[kLanes - 1] = static_cast<std::uint8_t>(pattern.triangles.size());
  }
}

}  // namespace footwall::isosurface::detail
