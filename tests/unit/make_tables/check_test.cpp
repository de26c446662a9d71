// The generator's checks, engine/isosurface/tables/check.h: whether they find what is wrong.
#include "engine/isosurface/tables/check.h"

#include <gtest/gtest.h>

#include <utility>

namespace footwall::isosurface::tables {
namespace {

constexpr unsigned kTunnelInside = 1U << 6;

const std::vector<SignCase>& made() {
  static const std::vector<SignCase> all = all_cases();
  return all;
}

TEST(Check, FindsTrianglesThatAreMissingTurnedOrElsewhere) {
  for (const unsigned signs : {1U, 9U, 23U, 105U, 129U, 150U}) {
    for (const auto& [alternative, entry] : made()[signs].entries) {
      ASSERT_EQ(fault_of(signs, alternative, entry, false), "");
      Entry missing = entry;
      missing.filling.triangles.pop_back();
      EXPECT_NE(fault_of(signs, alternative, missing, false), "");
      Entry turned = entry;
      std::swap(turned.filling.triangles[0][0], turned.filling.triangles[0][1]);
      EXPECT_NE(fault_of(signs, alternative, turned, false), "");
      Entry all_turned = entry;
      for (auto& triangle : all_turned.filling.triangles) std::swap(triangle[0], triangle[1]);
      EXPECT_EQ(fault_of(signs, alternative, all_turned, false), "a contour turned the wrong way");
      EXPECT_NE(fault_of(signs ^ 1U, alternative, entry, false), "");
    }
  }
}

TEST(Check, FindsAnotherFaceAnotherFormAndAFalseCentre) {
  const Entry& apart = made()[9].entries.at(0);  // corners 0 and 3
  EXPECT_EQ(fault_of(9, 1U << 4, apart, false), "a face joined the other way");
  Entry joined = apart;
  joined.loops = 1;
  EXPECT_EQ(fault_of(9, 0, joined, false), "the wrong Euler number");
  const Entry& tunnel = made()[129].entries.at(kTunnelInside);
  Entry two_discs = tunnel;
  two_discs.tunnels = 0;
  EXPECT_EQ(fault_of(129, 0, two_discs, false), "the wrong Euler number");
  Entry centre = apart;
  centre.filling.centre_edges = 7;
  EXPECT_NE(fault_of(9, 0, centre, false), "");
}

TEST(Check, FindsAChordThatTheNeighbourMayHave) {
  // Fans have such chords: that is why they are not what the tables use.
  int chords = 0;
  for (unsigned signs = 0; signs < 256; ++signs) {
    for (const auto& [alternative, entry] : made()[signs].fans) {
      EXPECT_EQ(fault_of(signs, alternative, entry, true), "");
      chords +=
          fault_of(signs, alternative, entry, false) == "a chord on a face that is the neighbour's" ? 1 : 0;
    }
  }
  EXPECT_GT(chords, 0);
}

TEST(Check, SampledFieldsMissATunnelThatIsNotListed) {
  int met = 0;
  EXPECT_EQ(fault_against_samples(made(), 20, met), "");
  EXPECT_GT(met, 256);
  std::vector<SignCase> poorer = made();
  poorer[129].entries.erase(kTunnelInside);
  EXPECT_NE(fault_against_samples(poorer, 20, met), "");
  // And with the tunnel alone, fields without one.
  poorer = made();
  poorer[129].entries.erase(0);
  EXPECT_NE(fault_against_samples(poorer, 20, met), "");
}

}  // namespace
}  // namespace footwall::isosurface::tables
