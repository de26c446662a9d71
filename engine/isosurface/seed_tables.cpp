#include "engine/isosurface/seed_tables.h"

#include <fmt/format.h>

#include <bit>

#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

bool has_ambiguous_face(unsigned signs) {
  return tables::kAmbiguousFaces[signs] != 0;
}

const Pattern& fan_of(unsigned signs, Alternative alternative) {
  return tables::kFans[tables::kFanOf[tables::kFirst[signs] + alternative]];
}

float intersection(float a, float b, float isovalue) {
  return (isovalue - a) / (b - a);
}

// By the intersections on the two edges of a face that run along u.
Alternative decide_by_positions(unsigned signs, const std::array<float, 8>& values, float isovalue) {
  unsigned joined = 0;
  for (unsigned face = 0; face < 6; ++face) {
    if ((tables::kAmbiguousFaces[signs] >> face & 1U) == 0) continue;
    const unsigned axis = face / 2;
    const unsigned u = axis == 0 ? 2 : 1;
    const unsigned w = axis == 2 ? 2 : 4;
    const unsigned a = (face & 1U) << axis;
    const float here = intersection(values[a], values[a | u], isovalue);
    const float there = intersection(values[a | w], values[a | u | w], isovalue);
    // Inside is below `here` on the one edge and beyond `there` on the other, or the other way round.
    const bool is_joined = (signs >> a & 1U) != 0 ? here >= there : here <= there;
    if (is_joined) joined |= 1U << face;
  }
  return static_cast<Alternative>(joined);
}

Alternative decide_by_entry(unsigned signs, const std::array<float, 8>& /*values*/, float /*isovalue*/) {
  const int above = std::popcount(signs);
  const bool keeps_above_apart = above < 4 || (above == 4 && signs < 128);
  return keeps_above_apart ? Alternative{0} : tables::kAmbiguousFaces[signs];
}

}  // namespace

const CaseRules& seed_000_rules() {
  static constexpr CaseRules kRules{has_ambiguous_face, decide_by_positions, fan_of};
  return kRules;
}

const CaseRules& seed_002_rules() {
  static constexpr CaseRules kRules{has_ambiguous_face, decide_by_entry, fan_of};
  return kRules;
}

const CaseRules& rules_of(std::string_view name) {
  if (name == "trilinear") return trilinear_rules();
  if (name == "seed000") return seed_000_rules();
  if (name == "seed002") return seed_002_rules();
  throw Error(ErrorCode::kUsage, fmt::format("there are no case tables called '{}'", name),
              "use trilinear, seed000 or seed002");
}

}  // namespace footwall::isosurface
