#include "engine/extract/discontinuity_volume.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "engine/verify/contrast_by_definition.h"
#include "storage/base/error.h"

namespace footwall::extract {
namespace {

class Volume {
 public:
  explicit Volume(const survey::Index& dims) : dims_(dims) {
    std::mt19937_64 random(static_cast<std::uint64_t>(dims[0] * 100 + dims[1] * 10 + dims[2]));
    for (std::int64_t n = 0; n < dims[0] * dims[1] * dims[2]; ++n) {
      float value = static_cast<float>(static_cast<std::int64_t>(random() % 2001) - 1000) / 128;
      max_abs_ = std::max(max_abs_, static_cast<double>(std::abs(value)));
      if (random() % 9 == 0) value = std::numeric_limits<float>::quiet_NaN();
      values_.push_back(value);
    }
  }
  float at(const survey::Index& p) const {
    return values_[static_cast<std::size_t>((p[0] * dims_[1] + p[1]) * dims_[2] + p[2])];
  }
  std::vector<float> values(const survey::Box& box) const {
    std::vector<float> all;
    for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
      for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
        for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) all.push_back(at({i, j, k}));
      }
    }
    return all;
  }
  double max_abs() const { return max_abs_; }

 private:
  survey::Index dims_;
  std::vector<float> values_;
  double max_abs_ = 0;
};

std::uint32_t bits(float value) {
  return std::isnan(value) ? 1 : std::bit_cast<std::uint32_t>(value);
}

TEST(DiscontinuityVolume, IsTheDefinitionInWholesAndInParts) {
  for (const survey::Index dims :
       {survey::Index{1, 1, 1}, {1, 9, 7}, {2, 2, 1}, {5, 4, 3}, {9, 8, 21}, {3, 1, 30}}) {
    const Volume volume(dims);
    for (const Window window :
         {Window{}, {3, 3, 1}, {5, 1, 3}, {1, 3, 1}, {7, 7, 5}, {11, 11, 63}, {3, 1, 3}}) {
      SCOPED_TRACE(testing::Message()
                   << dims[0] << "x" << dims[1] << "x" << dims[2] << " in " << text_of(window));
      DiscontinuityVolume kernel(window, dims, volume.max_abs());
      const survey::Index middle{dims[0] / 2, (dims[1] + 1) / 2, dims[2] / 2};
      for (const survey::Box& box : {survey::Box{{0, 0, 0}, dims}, survey::Box{{0, 0, 0}, middle},
                                     survey::Box{middle, dims}, survey::Box{{0, 0, middle[2]}, dims}}) {
        if (box.empty()) continue;
        std::vector<float> got(static_cast<std::size_t>(box.count()));
        kernel.compute(box, volume.values(needed_for(box, window, dims)), got);
        std::size_t n = 0;
        for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
          for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
            for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) {
              const float want = verify::attribute_by_definition(
                  {i, j, k}, {window.inlines, window.crosslines, window.samples}, dims,
                  [&](const survey::Index& p) { return volume.at(p); }, volume.max_abs());
              ASSERT_EQ(bits(got[n++]), bits(want)) << i << " " << j << " " << k;
            }
          }
        }
      }
    }
  }
}

TEST(DiscontinuityVolume, WithoutAVerticalWindowIsTheNumberOfAFaceOfOneVoxel) {
  const survey::Index dims{5, 5, 5};
  const Volume volume(dims);
  DiscontinuityVolume kernel({3, 3, 1}, dims, volume.max_abs());
  const survey::Box box{{0, 0, 0}, dims};
  std::vector<float> got(125);
  kernel.compute(box, volume.values(box), got);
  for (const survey::Index p : {survey::Index{2, 2, 2}, {0, 0, 0}, {4, 2, 3}}) {
    const double face = verify::statistics_by_definition(
                            std::span(&p, 1), dims, [&](const survey::Index& q) { return volume.at(q); },
                            volume.max_abs(), Outside::kInside)
                            .discontinuity;
    EXPECT_EQ(bits(got[static_cast<std::size_t>((p[0] * 5 + p[1]) * 5 + p[2])]),
              bits(static_cast<float>(face)));
  }
}

TEST(DiscontinuityVolume, ValuesAboveTheRecordedLargestAreRefused) {
  const survey::Index dims{3, 3, 3};
  DiscontinuityVolume kernel({}, dims, 1e-3);
  const std::vector<float> values(27, 1.0F);
  std::vector<float> out(27);
  EXPECT_THROW(kernel.compute({{0, 0, 0}, dims}, values, out), Error);
}

TEST(Window, IsThreeOddNumbers) {
  EXPECT_EQ(parse_window("3x3x9"), (Window{3, 3, 9}));
  EXPECT_EQ(text_of(parse_window("5x1x255")), "5x1x255");
  for (const char* wrong : {"", "3x3", "3x3x9x9", "2x3x9", "3x3x-9", "1x1x9", "33x3x9", "3x3x257", "axbxc"})
    EXPECT_THROW(parse_window(wrong), Error) << wrong;
}

}  // namespace
}  // namespace footwall::extract
