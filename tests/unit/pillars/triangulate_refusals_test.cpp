#include <gtest/gtest.h>

#include <limits>

#include "storage/base/error.h"
#include "unit/pillars/sound_mesh.h"
#include "unit/pillars/true_surface.h"

namespace footwall::pillars {
namespace {

using namespace testing;

// The message of the error that these pillars give; empty if they give none.
std::string complaint(const std::vector<PillarInput>& pillars, const Options& options = {}) {
  try {
    woven(pillars, options);
  } catch (const Error& e) {
    return e.message();
  }
  return {};
}

TEST(Triangulate, NamesPillarsThatCrossBeyondTheTolerance) {
  auto pillars = picked(planar, 4, 5, 20);
  pillars.push_back(slice(planar, 11, 40, 2, 80, 9, 5.0));
  const std::string message = complaint(pillars);
  EXPECT_NE(message.find("'T11'"), message.npos) << message;
  EXPECT_NE(message.find("(tolerance 2)"), message.npos) << message;
  EXPECT_EQ(complaint(pillars, {.tie_tolerance = 6}), "");
  // Where the interpreter finds it: by line numbers and in the survey's unit.
  survey::Geometry survey;
  survey.inlines = {.first = 1000, .step = 2, .count = 200};
  survey.crosslines = {.first = 300, .step = 1, .count = 200};
  survey.z0 = 100;
  survey.interval = 4;
  EXPECT_EQ(place_text_of(survey)({10, 20.25, 40.5}), "inline 1020, crossline 320.3, 262 ms");
  EXPECT_EQ(index_text({10, 20.25, 40.5}), "inline index 10, crossline index 20.3, sample 40.5");
  const std::string placed = complaint(pillars, {.place_text = place_text_of(survey)});
  EXPECT_NE(placed.find("inline 1212.4, crossline 370, 268.1 ms with 4.15 voxels"), placed.npos) << placed;
}

TEST(Triangulate, NamesFoldedPillars) {
  auto pillars = picked(planar, 3, 5, 20);
  auto& nodes = pillars[1].nodes;
  nodes = {{75, 30, 10}, {75, 30, 60}, {75, 36, 60}, {75, 36, 40}, {75, 26, 40}, {75, 26, 90}};
  pillars[1].node_ids.clear();
  EXPECT_NE(complaint(pillars).find("'P2' is folded"), std::string::npos) << complaint(pillars);
  nodes = {{75, 30, 10}, {75, 30, 60}, {75, 30, 30}};
  EXPECT_NE(complaint(pillars).find("'P2' is folded"), std::string::npos) << complaint(pillars);
}

TEST(Triangulate, NamesPillarsOnTopOfEachOther) {
  auto pillars = picked(planar, 3, 5, 20);
  pillars.push_back(pillars[1]);
  pillars.back().id = 9;
  pillars.back().name_for_messages = "twin";
  const std::string message = complaint(pillars);
  EXPECT_NE(message.find("'P2'"), message.npos) << message;
  EXPECT_NE(message.find("'twin'"), message.npos) << message;
}

TEST(Triangulate, RefusesWhatMakesNoSurface) {
  EXPECT_NE(complaint({}), "");
  EXPECT_NE(complaint({picked(planar, 1, 5, 10)[0]}), "");
  EXPECT_NE(complaint(picked(planar, 2, 1, 10)), "");
  EXPECT_NE(complaint(picked(planar, 4, 1, 10)).find("one line"), std::string::npos);
  auto nan = picked(planar, 3, 4, 10);
  nan[2].nodes[1].k = std::nan("");
  EXPECT_NE(complaint(nan).find("'P3'"), std::string::npos);
  auto empty = picked(planar, 3, 4, 10);
  empty[1].nodes.clear();
  empty[1].node_ids.clear();
  EXPECT_NE(complaint(empty).find("'P2'"), std::string::npos);
  auto twice = picked(planar, 3, 4, 10);
  twice[1].id = 1;
  EXPECT_NE(complaint(twice), "");
  for (double bad : {0.0, -1.0, std::nan("")}) {
    EXPECT_NE(complaint(picked(planar, 3, 4, 10), {.detail = bad}), "");
    EXPECT_NE(complaint(picked(planar, 3, 4, 10), {.max_edge = bad}), "");
  }
  EXPECT_NE(complaint({{1, "a", {{0, 0, 0}, {0, 0, 9}}, {}}, {2, "b", {{0, 9, 0}, {0, 9, 1e9}}, {}}},
                      {.max_edge = 1}),
            "");
}

}  // namespace
}  // namespace footwall::pillars
