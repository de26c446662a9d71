#include "engine/tasks/crop_volume.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "made_source.h"
#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

Error error_of(const Crop& crop) {
  std::vector<std::string> notices;
  try {
    cropped(made_source(), crop, notices);
  } catch (const Error& error) {
    return error;
  }
  return {ErrorCode::kInternal, "nothing was thrown"};
}

TEST(CropVolume, TakesLinesSamplesAndStridesByNumber) {
  Crop crop;
  crop.inlines = LineRange{104, 112, 4};      // of 100 to 118 by 2
  crop.crosslines = LineRange{-40, -20, 15};  // of -50 to -15 by 5: -40, -25
  crop.z = DepthRange{1012.0, 1040.0, 8.0};   // of 1000 by 4
  std::vector<std::string> notices;
  const VolumeSource whole = made_source();
  const VolumeSource part = cropped(made_source(), crop, notices);
  const survey::Geometry& g = part.geometry;
  EXPECT_EQ(g.inlines, (survey::LineAxis{104, 4, 3}));
  EXPECT_EQ(g.crosslines, (survey::LineAxis{-40, 15, 2}));
  EXPECT_EQ(g.samples, 4);
  EXPECT_EQ(g.z0, 1012);
  EXPECT_EQ(g.interval, 8);
  g.validate();
  std::vector<float> values(3 * 2 * 4);
  std::vector<std::uint8_t> live(6, 1);
  part.fill(g.box(), values, live);
  for (std::int64_t i = 0; i < 3; ++i) {
    for (std::int64_t j = 0; j < 2; ++j) {
      // The same trace, found through its line numbers and, apart from that, through its coordinates.
      const std::int64_t old_i = whole.geometry.inlines.index_of(g.inlines.line_of(i));
      const std::int64_t old_j = whole.geometry.crosslines.index_of(g.crosslines.line_of(j));
      const auto at = whole.geometry.index_of(g.world_of({double(i), double(j), 0}));
      EXPECT_NEAR(at.i, double(old_i), 1e-9);
      EXPECT_NEAR(at.j, double(old_j), 1e-9);
      EXPECT_EQ(live[i * 2 + j], made_live(old_i, old_j) ? 1 : 0);
      for (std::int64_t k = 0; k < 4; ++k) {
        EXPECT_EQ(values[(i * 2 + j) * 4 + k], made_value(old_i, old_j, 3 + 2 * k));
      }
    }
  }
  EXPECT_TRUE(notices.empty());
}

TEST(CropVolume, AnyBoxOfThePartIsRead) {
  for (const std::int64_t step : {1, 2}) {
    Crop crop;
    crop.inlines = LineRange{102, {}, 2 * step};
    std::vector<std::string> notices;
    const VolumeSource part = cropped(made_source(), crop, notices);
    const survey::Box box{{1, 3, 2}, {3, 6, 5}};
    std::vector<float> values(static_cast<std::size_t>(box.count()));
    std::vector<std::uint8_t> live(6, 1);
    part.fill(box, values, live);
    EXPECT_EQ(values.front(), made_value(1 + step, 3, 2));
    EXPECT_EQ(values.back(), made_value(1 + 2 * step, 5, 4));
  }
}

TEST(CropVolume, ClipsToTheFileAndSaysSo) {
  Crop crop;
  crop.inlines = LineRange{90, 104, {}};
  crop.z = DepthRange{{}, 99999.0, {}};
  std::vector<std::string> notices;
  const VolumeSource part = cropped(made_source(), crop, notices);
  EXPECT_EQ(part.geometry.inlines, (survey::LineAxis{100, 2, 3}));
  EXPECT_EQ(part.geometry.samples, 12);
  ASSERT_EQ(notices.size(), 2u);
  EXPECT_NE(notices[0].find("100 to 118"), std::string::npos) << notices[0];
}

TEST(CropVolume, OneLineAloneKeepsTheFilesStep) {
  Crop crop;
  crop.inlines = LineRange{104, 105, 8};
  std::vector<std::string> notices;
  const VolumeSource part = cropped(made_source(), crop, notices);
  EXPECT_EQ(part.geometry.inlines, (survey::LineAxis{104, 2, 1}));
}

TEST(CropVolume, RefusesWithTheFilesRanges) {
  Crop nothing;
  nothing.inlines = LineRange{119, 500, {}};
  EXPECT_EQ(error_of(nothing).code(), ErrorCode::kInvalid);
  EXPECT_NE(error_of(nothing).message().find("100 to 118 by 2"), std::string::npos);
  Crop between;  // no line has this number
  between.inlines = LineRange{101, 101, {}};
  EXPECT_EQ(error_of(between).code(), ErrorCode::kInvalid);
  Crop odd;
  odd.crosslines = LineRange{{}, {}, 7};
  EXPECT_EQ(error_of(odd).code(), ErrorCode::kUsage);
  EXPECT_NE(error_of(odd).hint().find("multiple of 5"), std::string::npos);
  Crop backward;
  backward.inlines = LineRange{{}, {}, -2};
  EXPECT_EQ(error_of(backward).code(), ErrorCode::kUsage);
  Crop fraction;
  fraction.z = DepthRange{{}, {}, 6.0};
  EXPECT_EQ(error_of(fraction).code(), ErrorCode::kUsage);
  Crop below;
  below.z = DepthRange{5000.0, {}, {}};
  EXPECT_EQ(error_of(below).code(), ErrorCode::kInvalid);
  Crop huge;
  huge.inlines = LineRange{std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max(),
                           std::numeric_limits<std::int64_t>::max() - 1};
  std::vector<std::string> notices;
  EXPECT_EQ(cropped(made_source(), huge, notices).geometry.inlines.count, 1);
}

TEST(CropVolume, ProvenanceTellsThePart) {
  Crop crop;
  crop.z = DepthRange{1008.0, 1016.0, {}};
  std::vector<std::string> notices;
  const auto told = nlohmann::json::parse(cropped(made_source(), crop, notices).provenance_json);
  EXPECT_EQ(told["importer"], "made");
  EXPECT_EQ(told["crop"]["z"], (nlohmann::json{1008.0, 1016.0, 4.0}));
}

}  // namespace
}  // namespace footwall::tasks
