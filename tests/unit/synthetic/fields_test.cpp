#include "engine/synthetic/fields.h"

#include <gtest/gtest.h>

#include <cmath>

#include "storage/base/error.h"

namespace footwall::synthetic {
namespace {

float at(const SampledField& field, std::size_t size, std::size_t i, std::size_t j, std::size_t k) {
  return field.values[(i * size + j) * size + k];
}

TEST(Fields, TheSphereHasItsRadius) {
  const SampledField field = make_field("sphere", 21);
  ASSERT_EQ(field.values.size(), 21u * 21 * 21);
  EXPECT_FLOAT_EQ(at(field, 21, 10, 10, 10), 8.4F);
  EXPECT_FLOAT_EQ(at(field, 21, 10, 13, 14), 8.4F - 5);
  EXPECT_FLOAT_EQ(at(field, 21, 14, 10, 7), 8.4F - 5);
  EXPECT_EQ(field.isovalue, 0);
}

TEST(Fields, TheGyroidIsTheSumOfItsWaves) {
  constexpr std::size_t kSize = 40;
  const SampledField field = make_field("gyroid", kSize);
  const auto angle = [](std::size_t n) { return 2 * M_PI * 8.38 * static_cast<double>(n) / kSize; };
  for (const auto& [i, j, k] : {std::array<std::size_t, 3>{0, 0, 0}, {7, 1, 30}, {39, 20, 11}}) {
    const double x = angle(k), y = angle(j), z = angle(i);
    EXPECT_NEAR(at(field, kSize, i, j, k),
                std::sin(x) * std::cos(y) + std::sin(y) * std::cos(z) + std::sin(z) * std::cos(x), 1e-5);
  }
}

TEST(Fields, TheEnvelopeHasFewStrongPlaces) {
  const SampledField field = make_field("envelope", 48);
  double sum = 0, above = 0;
  for (const float value : field.values) {
    ASSERT_GE(value, 0);
    ASSERT_LT(value, 60);  // 40 waves of at most 1.5
    sum += value;
    above += value >= field.isovalue ? 1 : 0;
  }
  EXPECT_NEAR(field.isovalue, 1.9 * sum / static_cast<double>(field.values.size()), 1e-4);
  EXPECT_LT(above / static_cast<double>(field.values.size()), 0.15);
}

TEST(Fields, OthersAreNotMade) {
  for (const FieldKind& kind : field_kinds()) EXPECT_EQ(make_field(kind.name, 3).values.size(), 27u);
  EXPECT_THROW(make_field("cube", 8), Error);
  EXPECT_THROW(make_field("sphere", 1), Error);
  EXPECT_THROW(make_field("sphere", 1 << 20), Error);
}

}  // namespace
}  // namespace footwall::synthetic
