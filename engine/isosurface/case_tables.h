// Which triangles a cell has. The patterns are made by a program in the build (tables/), which checks every
// one of them (docs/isosurface-cases.md).
// Based on: seed 000, section 3 (all 256 cases listed by a program); Chernyaev, Marching Cubes 33, 1995;
// differs in that the interior is decided as the trilinear field does (Custodio and others, 2013).
//
// Corner c of a cell is its sample (c & 1, c >> 1 & 1, c >> 2 & 1); bit c of `signs` is set where the value
// is at or above the isovalue. Edge 4 * axis + n runs along `axis` from the corner whose coordinates on the
// two other axes, in ascending order of axes, are n & 1 and n >> 1. Number 12 is the cell's centre vertex.
// Face 2 * axis + side.
#pragma once
#include <array>
#include <cassert>
#include <cstdint>
#include <span>

namespace footwall::isosurface {

inline constexpr int kCentre = 12;
// Around the centre, one for each side of a loop through all edges.
inline constexpr std::uint64_t kMostTrianglesOfCell = 12;

// How an undecided cell is decided: bit f: on the ambiguous face f the corners at or above the isovalue are
// joined; bit 6: inside the cell a tunnel joins corners at or above the isovalue that the faces keep apart;
// bit 7: a tunnel joins corners below it. 0 for a cell without ambiguity.
using Alternative = std::uint8_t;
inline constexpr Alternative kTunnelAbove = 1 << 6;
inline constexpr Alternative kTunnelBelow = 1 << 7;

struct Pattern {
  std::span<const std::array<std::uint8_t, 3>>
      triangles;  // edges 0..11 or kCentre; see Surface for the winding
  bool has_centre = false;
  // The loop that the centre vertex fills: bit e: the vertex on edge e. It stands at their mean, and its
  // normal is their mean, made a unit vector.
  std::uint16_t centre_edges = 0;
};

// The pattern of a decided case in one 16-byte load. No decided case has a centre or more than 5 triangles.
struct PackedPattern {
  static constexpr std::uint8_t kUndecided = 255;
  std::uint8_t triangles = 0;               // or kUndecided
  std::array<std::uint8_t, 15> edges = {};  // 3 each
};

// By signs 0..255, written by the build.
namespace tables {
extern const std::array<std::uint8_t, 256> kAmbiguousFaces;  // bit f: the face f is ambiguous
extern const std::array<std::uint16_t, 256> kCutEdges;       // bit e: the edge e has a vertex
extern const std::array<PackedPattern, 256> kPacked;
// kPatterns[kPatternOf[kFirst[signs] + alternative]]; kNoPattern where the signs cannot have it.
inline constexpr std::uint16_t kNoPattern = 0xFFFF;
extern const std::array<std::uint16_t, 256> kFirst;
extern const std::span<const std::uint16_t> kPatternOf;
extern const std::span<const Pattern> kPatterns;
// The same for the faces' loops as polygons fanned from their first vertex; without tunnels.
extern const std::span<const std::uint16_t> kFanOf;
extern const std::span<const Pattern> kFans;
}  // namespace tables

// Whether more than the signs decide: an ambiguous face, or an ambiguous interior.
inline bool is_undecided(unsigned signs) {
  return tables::kPacked[signs].triangles == PackedPattern::kUndecided;
}
// Whether the signs can have the alternative (0 for decided ones).
inline bool has_pattern(unsigned signs, Alternative alternative) {
  return alternative == 0 || is_undecided(signs)
             ? tables::kPatternOf[tables::kFirst[signs] + alternative] != tables::kNoPattern
             : false;
}
// The pattern of signs 0..255. Asking for an alternative that the signs cannot have is a broken precondition
// (assert). Complements have the same triangles in the same order, each turned over:
// pattern_of(signs, a) and pattern_of(255 - signs, complement_of(signs, a)).
inline const Pattern& pattern_of(unsigned signs, Alternative alternative = 0) {
  assert(has_pattern(signs, alternative));
  return tables::kPatterns[tables::kPatternOf[tables::kFirst[signs] + alternative]];
}
inline Alternative complement_of(unsigned signs, Alternative alternative) {
  const unsigned faces = (alternative ^ tables::kAmbiguousFaces[signs]) & 63U;
  return static_cast<Alternative>(faces | (alternative & kTunnelAbove) << 1 |
                                  (alternative & kTunnelBelow) >> 1);
}

// The alternative of a cell whose corners have these values, none of them NaN. The same for the cells on both
// sides of a face, exactly: signs of products are taken without rounding errors. A saddle at the isovalue
// joins the corners at or above it. An infinite value counts as the largest float of its sign.
Alternative decide(unsigned signs, const std::array<float, 8>& values, float isovalue);

// A set of rules for undecided cells; `decide` and `pattern` are called where `undecided` says so, `pattern`
// with alternative 0 elsewhere.
struct CaseRules {
  bool (*undecided)(unsigned signs);
  Alternative (*decide)(unsigned signs, const std::array<float, 8>& values, float isovalue);
  const Pattern& (*pattern)(unsigned signs, Alternative alternative);
};
// The three functions above. The seeds' own rules are in seed_tables.h.
const CaseRules& trilinear_rules();

}  // namespace footwall::isosurface
