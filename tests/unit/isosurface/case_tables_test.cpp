#include "engine/isosurface/case_tables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "random_cells.h"

namespace footwall::isosurface {
namespace {

template <class Visit>
void for_each_pattern(const Visit& visit) {
  for (unsigned signs = 0; signs < 256; ++signs) {
    for (unsigned alternative = 0; alternative < 256; ++alternative) {
      if (has_pattern(signs, static_cast<Alternative>(alternative)))
        visit(signs, static_cast<Alternative>(alternative));
    }
  }
}

// Bit f: the edge lies on the face f.
unsigned faces_of(unsigned edge) {
  const unsigned axis = edge / 4;
  const unsigned u = axis == 0 ? 1 : 0;
  const unsigned w = axis == 2 ? 1 : 2;
  return 1U << (2 * u + (edge & 1U)) | 1U << (2 * w + (edge >> 1 & 1U));
}

TEST(CaseTables, EveryCombinationOfFacesHasAPatternAndTunnelsOnlyWhereTwoLoopsFaceEachOther) {
  int patterns = 0;
  int tunnels = 0;
  for (unsigned signs = 0; signs < 256; ++signs) {
    const unsigned ambiguous = tables::kAmbiguousFaces[signs];
    for (unsigned faces = 0; faces < 64; ++faces) {
      EXPECT_EQ(has_pattern(signs, static_cast<Alternative>(faces)), (faces & ~ambiguous) == 0) << signs;
    }
  }
  for_each_pattern([&](unsigned signs, Alternative alternative) {
    ++patterns;
    if ((alternative & (kTunnelAbove | kTunnelBelow)) == 0) return;
    ++tunnels;
    EXPECT_GE(meaning(signs, alternative & 63U).euler, 2);
  });
  EXPECT_EQ(is_undecided(0b10000001), true);
  EXPECT_EQ(has_pattern(0b10000001, kTunnelAbove), true);
  EXPECT_EQ(has_pattern(0b10000001, kTunnelBelow), false);
  // Chernyaev's 4.1.2, 6.1.2, 7.4.2, 10.1.2, 12.1.2 and 13.5.2 in all positions.
  EXPECT_EQ(tunnels, 8 + 48 + 16 + 12 + 48 + 16);
  EXPECT_GT(patterns, 256 + tunnels);
}

TEST(CaseTables, TrianglesCloseUpInsideTheCellAndEndOnItsFaces) {
  for_each_pattern([](unsigned signs, Alternative alternative) {
    const Pattern& pattern = pattern_of(signs, alternative);
    std::set<std::pair<int, int>> directed;
    std::set<int> vertices;
    for (const auto& triangle : pattern.triangles) {
      for (std::size_t n = 0; n < 3; ++n) {
        EXPECT_TRUE(directed.insert({triangle[n], triangle[(n + 1) % 3]}).second) << signs;
        vertices.insert(triangle[n]);
      }
    }
    int edges = 0;
    for (const auto& [from, to] : directed) {
      const bool inner = directed.count({to, from}) != 0;
      const bool centre = from == kCentre || to == kCentre;
      const bool on_face =
          !centre && (faces_of(static_cast<unsigned>(from)) & faces_of(static_cast<unsigned>(to))) != 0;
      EXPECT_TRUE(inner || on_face) << signs << " " << int{alternative};
      edges += inner ? 1 : 2;
    }
    unsigned used = 0;
    for (const int vertex : vertices) used |= vertex == kCentre ? 0U : 1U << vertex;
    EXPECT_EQ(used, tables::kCutEdges[signs]);
    EXPECT_EQ(vertices.count(kCentre) != 0, pattern.has_centre);
    EXPECT_EQ(pattern.centre_edges != 0, pattern.has_centre);
    EXPECT_EQ(static_cast<int>(vertices.size() + pattern.triangles.size()) - edges / 2,
              meaning(signs, alternative).euler)
        << signs << " " << int{alternative};
  });
}

// Two cells that share a face never have the same chord on it, or four triangles would meet there: what a
// face has as a chord on the one side of any cell, it has on the other side of none.
TEST(CaseTables, NeighboursNeverShareAChord) {
  std::set<std::array<unsigned, 3>> chords[2];  // by side: axis, and places of the two edges on the face
  for_each_pattern([&](unsigned signs, Alternative alternative) {
    std::set<std::pair<unsigned, unsigned>> directed;
    for (const auto& triangle : pattern_of(signs, alternative).triangles) {
      for (std::size_t n = 0; n < 3; ++n) directed.insert({triangle[n], triangle[(n + 1) % 3]});
    }
    for (const auto& [a, b] : directed) {
      if (a == kCentre || b == kCentre || a > b || directed.count({b, a}) == 0) continue;
      for (unsigned face = 0; face < 6; ++face) {
        if ((faces_of(a) & faces_of(b) & 1U << face) == 0) continue;
        // The place without the coordinate across the face.
        const auto place = [&](unsigned edge) {
          const unsigned bit = (edge / 4 == 0 ? face / 2 == 1 : face / 2 == 0) ? 1U : 2U;
          return edge / 4 * 4 + ((edge & 3U) & ~bit);
        };
        chords[face & 1U].insert({face / 2, place(a), place(b)});
      }
    }
  });
  for (const auto& chord : chords[0]) EXPECT_EQ(chords[1].count(chord), 0U);
}

// One corner above: the triangle around it is counter-clockwise as seen from below the isovalue, that is from
// away from the corner.
TEST(CaseTables, TrianglesTurnTheirFrontToLowerValues) {
  const Pattern& pattern = pattern_of(1);
  ASSERT_EQ(pattern.triangles.size(), 1U);
  std::array<std::uint8_t, 3> triangle = pattern.triangles[0];
  std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  EXPECT_EQ(triangle, (std::array<std::uint8_t, 3>{0, 4, 8}));
}

TEST(CaseTables, ComplementsAreTheSameTrianglesTurnedOver) {
  for_each_pattern([](unsigned signs, Alternative alternative) {
    const Alternative other = complement_of(signs, alternative);
    ASSERT_TRUE(has_pattern(255 - signs, other));
    const Pattern& here = pattern_of(signs, alternative);
    const Pattern& there = pattern_of(255 - signs, other);
    ASSERT_EQ(here.triangles.size(), there.triangles.size());
    EXPECT_EQ(here.centre_edges, there.centre_edges);
    for (std::size_t n = 0; n < here.triangles.size(); ++n) {
      const auto& [a, b, c] = here.triangles[n];
      EXPECT_EQ(there.triangles[n], (std::array<std::uint8_t, 3>{a, c, b}));
    }
    EXPECT_EQ(complement_of(255 - signs, other), alternative);
  });
}

TEST(CaseTables, PackedPatternsAreThoseOfTheDecidedCases) {
  for (unsigned signs = 0; signs < 256; ++signs) {
    const PackedPattern& packed = tables::kPacked[signs];
    if (is_undecided(signs)) continue;
    const Pattern& pattern = pattern_of(signs);
    ASSERT_EQ(packed.triangles, pattern.triangles.size());
    for (std::size_t n = 0; n < pattern.triangles.size(); ++n) {
      for (std::size_t v = 0; v < 3; ++v) EXPECT_EQ(packed.edges[3 * n + v], pattern.triangles[n][v]);
    }
  }
}

}  // namespace
}  // namespace footwall::isosurface
