#include "engine/extract/face_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "engine/voxelize/registry.h"
#include "storage/base/error.h"

namespace footwall::extract {
namespace {

constexpr std::int64_t kSize = 128;

// A triangle of one voxel's thickness in the plane i = 3.
class FilteredFace {
 public:
  FilteredFace() {
    const auto at = [](int j, int k) { return survey::LatticePoint{3 * 256, 256 * j, 256 * k}; };
    face_.triangle = {at(4, 4), at(120, 10), at(20, 120)};
    voxelize::make_voxelizer()->rows(face_.triangle, {{0, 0, 0}, {8, kSize, kSize}}, rows_);
  }
  // Values by position; what comes back, in the same order.
  std::vector<float> operator()(const std::string& filter,
                                const std::function<float(const survey::Index&)>& value) {
    values_.clear();
    rows_.for_each([&](const survey::Index& p) { values_.push_back(value(p)); });
    Options options;
    options.filter = filter;
    std::vector<std::byte> bytes;
    const auto computation = make_face_filter(options);
    computation->compute({face_, rows_, values_}, bytes);
    std::vector<std::byte> again;
    computation->compute({face_, rows_, values_}, again);
    EXPECT_EQ(bytes, again);
    EXPECT_EQ(bytes.size(), values_.size() * sizeof(float));
    std::vector<float> out(bytes.size() / sizeof(float));
    std::memcpy(out.data(), bytes.data(), bytes.size());
    return out;
  }
  const std::vector<float>& values() const { return values_; }

 private:
  Face face_;
  FaceRows rows_;
  std::vector<float> values_;
};

float wave(const survey::Index& p, double length) {
  return static_cast<float>(std::sin(2 * std::numbers::pi * static_cast<double>(p[1]) / length));
}

double rms(const std::vector<float>& values) {
  double sum = 0;
  for (const float value : values) sum += static_cast<double>(value) * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

TEST(FaceFilter, ABandKeepsWhatIsInIt) {
  FilteredFace face;
  const double inside = rms(face("band=4,64", [](const auto& p) { return wave(p, 12); }));
  const double too_short = rms(face("band=16,64", [](const auto& p) { return wave(p, 3); }));
  const double too_long = rms(face("band=4,16", [](const auto& p) { return wave(p, 100); }));
  const double whole = rms(face.values());
  EXPECT_GT(inside, 0.6 * std::sqrt(0.5));
  EXPECT_LT(too_short, 0.05);
  EXPECT_LT(too_long, 0.2 * whole);
}

TEST(FaceFilter, AConstantHasNoBandAndIsNotSharpenedAlsoAtTheEdgeAndBesideNulls) {
  FilteredFace face;
  const auto five = [](const survey::Index& p) {
    return (p[1] + p[2]) % 7 == 0 ? std::numeric_limits<float>::quiet_NaN() : 5.0F;
  };
  for (const char* filter : {"band=4,32", "band=0,32"}) {
    const std::vector<float> out = face(filter, five);
    for (std::size_t n = 0; n < out.size(); ++n) {
      ASSERT_EQ(std::isnan(out[n]), std::isnan(face.values()[n]));
      if (!std::isnan(out[n])) {
        ASSERT_NEAR(out[n], 0, 5e-6);
      }
    }
  }
  const std::vector<float> sharp = face("sharpen=2,8", five);
  for (const float value : sharp) {
    if (!std::isnan(value)) {
      ASSERT_NEAR(value, 5, 5e-6);
    }
  }
}

TEST(FaceFilter, ANarrowBandAndItsComplementAddUp) {
  // band=0,L is what L's low-pass takes away: sharpen by 1 adds exactly that.
  FilteredFace face;
  const auto value = [](const survey::Index& p) { return wave(p, 9) + static_cast<float>(p[2] % 5); };
  const std::vector<float> high = face("band=0,8", value);
  const std::vector<float> sharp = face("sharpen=1,8", value);
  for (std::size_t n = 0; n < high.size(); ++n) ASSERT_NEAR(sharp[n], face.values()[n] + high[n], 1e-5);
}

TEST(FaceFilter, WhatIsNoFilterIsRefused) {
  for (const char* wrong : {"", "blur=3", "band=8,4", "band=1,9", "band=4,4", "band=-1,9", "band=4,99999",
                            "sharpen=x", "sharpen=1,1", "band=4,8,9"}) {
    Options options;
    options.filter = wrong;
    EXPECT_THROW(make_face_filter(options), Error) << wrong;
  }
  Options plain;
  EXPECT_NO_THROW(make_face_filter(plain));
  plain.filter = "sharpen";
  EXPECT_NO_THROW(make_face_filter(plain));
}

TEST(FaceFilter, AFaceWithoutVoxelsHasNoBytes) {
  const Face face;
  const FaceRows rows;
  std::vector<std::byte> bytes;
  make_face_filter({})->compute({face, rows, {}}, bytes);
  EXPECT_TRUE(bytes.empty());
}

}  // namespace
}  // namespace footwall::extract
