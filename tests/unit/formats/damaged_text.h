// Reads damaged copies of a text: whatever is in them, a reader reads or refuses.
#pragma once
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <string_view>

#include "rounds.h"
#include "storage/base/error.h"
#include "storage/formats/sticks.h"

namespace footwall::formats {

// Cuts, changes, doubles and swaps pieces of `good`; the same from run to run.
std::string damaged(const std::string& good, std::mt19937_64& random);

template <class Parse>
void expect_damage_is_survived(const std::string& good, const Parse& parse) {
  std::mt19937_64 random(1991);
  int read = 0, refused = 0;
  for (int round = 0; round < rounds(3000); ++round) {
    const std::string text = damaged(good, random);
    try {
      const SticksImport result = parse(text);
      std::size_t points = 0;
      for (const Stick& stick : result.sticks) {
        EXPECT_FALSE(stick.points.empty());
        EXPECT_FALSE(stick.fault.empty());
        points += stick.points.size();
      }
      EXPECT_EQ(static_cast<std::size_t>(result.report.read), points);
      ++read;
    } catch (const Error& error) {
      EXPECT_NE(error.code(), ErrorCode::kInternal) << error.what();
      EXPECT_FALSE(error.message().empty());
      ++refused;
    }
  }
  EXPECT_GT(read, 0);
  EXPECT_GT(refused, 0);
}

// Points of `again` are those of `first`, to half of 1e-4.
inline void expect_same_sticks(const std::vector<Stick>& first, const std::vector<Stick>& again) {
  ASSERT_EQ(first.size(), again.size());
  for (std::size_t n = 0; n < first.size(); ++n) {
    EXPECT_EQ(first[n].fault, again[n].fault);
    ASSERT_EQ(first[n].points.size(), again[n].points.size()) << "stick " << n;
    for (std::size_t k = 0; k < first[n].points.size(); ++k) {
      EXPECT_NEAR(first[n].points[k].x, again[n].points[k].x, 0.5001e-4);
      EXPECT_NEAR(first[n].points[k].y, again[n].points[k].y, 0.5001e-4);
      EXPECT_NEAR(first[n].points[k].z, again[n].points[k].z, 0.5001e-4);
    }
  }
}

// Two faults with blanks and UTF-8 in their names, a stick of one point, a closed one, positions of UTM size.
inline std::vector<Stick> sample_sticks(bool one_fault) {
  const std::string second = one_fault ? "Big fault 1" : "\xC3\x86gir s\xC3\xB8r";
  return {{"Big fault 1", 1, {{458177.76712, 7322538.71289, 1643.65588}, {458178.5, 7322540.25, 1702.125}}},
          {"Big fault 1", 2, {{458200.1, 7322600.2, 1650.3}}},
          {second, 1, {{-0.00012, 999.0, 999.0}, {10, 999.0, 1e-3}, {20.5, 3, 0}, {-0.00012, 999.0, 999.0}}}};
}

inline bool says(const std::vector<std::string>& lines, std::string_view what) {
  for (const std::string& line : lines) {
    if (line.find(what) != std::string::npos) return true;
  }
  return false;
}

}  // namespace footwall::formats
