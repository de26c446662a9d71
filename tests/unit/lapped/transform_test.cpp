#include "engine/extract/lapped/transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/verify/lapped_by_definition.h"
#include "engine/voxelize/simd.h"

namespace footwall::extract::lapped {
namespace {

verify::LappedMatrix matrix_of(Angles angles) {
  return verify::lapped_matrix(angles == Angles::kTuned ? std::array{0.204L, -0.315L, -0.037L}
                                                        : std::array{0.13L, 0.16L, 0.13L});
}

// Of an AR(1) process.
std::array<long double, 16> first_order(long double rho) {
  std::array<long double, 16> lags{};
  for (std::size_t n = 0; n < lags.size(); ++n) lags[n] = std::pow(rho, static_cast<long double>(n));
  return lags;
}

// Of an AR(2) process with a pole of radius 0.95 at a frequency in cycles per sample.
std::array<long double, 16> second_order(long double frequency) {
  const long double a1 = 2 * 0.95L * std::cos(2 * std::acos(-1.0L) * frequency);
  const long double a2 = -0.95L * 0.95L;
  std::array<long double, 16> lags{1, a1 / (1 - a2)};
  for (std::size_t n = 2; n < lags.size(); ++n) lags[n] = a1 * lags[n - 1] + a2 * lags[n - 2];
  return lags;
}

std::vector<float> noise(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  std::vector<float> values(n);
  for (float& value : values) value = normal(random);
  return values;
}

class EveryAngles : public testing::TestWithParam<Angles> {};
INSTANTIATE_TEST_SUITE_P(Lapped, EveryAngles, testing::Values(Angles::kStandard, Angles::kTuned));

TEST_P(EveryAngles, ConstantsAreTheDefinition) {
  const verify::LappedMatrix definition = matrix_of(GetParam());
  verify::LappedMatrix constants{};
  for (std::size_t t = 0; t < kTaps; ++t) {
    for (std::size_t k = 0; k < kBands; ++k) {
      constants[t][k] = basis(GetParam())[t][k];
      EXPECT_NEAR(static_cast<double>(constants[t][k] - definition[t][k]), 0, 3e-16);
    }
  }
  EXPECT_LT(verify::distance_from_orthonormal(constants), 1e-15L);
}

TEST(Lapped, CodingGainTellsTheSignsOfTheAngles) {
  const verify::LappedMatrix standard = matrix_of(Angles::kStandard);
  EXPECT_GE(verify::coding_gain_db(standard, first_order(0.95L)), 9.19L);
  EXPECT_LT(verify::coding_gain_db(verify::lapped_matrix({-0.13L, -0.16L, -0.13L}), first_order(0.95L)),
            9.0L);
  // Band-limited values are what the tuned angles are for.
  const verify::LappedMatrix tuned = matrix_of(Angles::kTuned);
  EXPECT_GE(verify::coding_gain_db(tuned, second_order(0.12L)),
            verify::coding_gain_db(standard, second_order(0.12L)) + 1.2L);
}

TEST_P(EveryAngles, LineIsTheMatrixProductAndComesBack) {
  const verify::LappedMatrix matrix = matrix_of(GetParam());
  for (const std::size_t blocks : {1U, 2U, 3U, 17U}) {
    const std::vector<float> values = noise(blocks * kBands, 5);
    std::vector<float> coefficients(values.size());
    forward(values, GetParam(), coefficients);
    const std::vector<long double> exact(values.begin(), values.end());
    const std::vector<long double> expected = verify::lapped_forward(exact, matrix);
    std::vector<float> back(values.size());
    inverse(coefficients, GetParam(), back);
    for (std::size_t n = 0; n < values.size(); ++n) {
      EXPECT_NEAR(coefficients[n], static_cast<double>(expected[n]), 2e-6) << blocks << " blocks, " << n;
      EXPECT_NEAR(back[n], values[n], 2e-6) << blocks << " blocks, " << n;
    }
  }
}

// 3 x 2 tiles, and then the same with the last one missing.
std::vector<Tile> tiles(bool with_last) {
  constexpr std::uint32_t kNone = Tile::kNone;
  std::vector<Tile> field{{kNone, 1, kNone, 3}, {0, 2, kNone, 4}, {1, kNone, kNone, 5},
                          {kNone, 4, 0, kNone}, {3, 5, 1, kNone}, {4, kNone, 2, kNone}};
  if (with_last) return field;
  field.pop_back();
  field[2].below = kNone;
  field[4].right = kNone;
  return field;
}

TEST(Lapped, FieldIsTheProductAlongRowsAndColumns) {
  const std::vector<Tile> field = tiles(true);
  const std::vector<float> values = noise(field.size() * kSquare, 6);
  std::vector<float> work(values.size());
  std::vector<float> coefficients(values.size());
  forward(field, values, Angles::kTuned, Angles::kStandard, work, coefficients);
  constexpr std::size_t kWide = 24;
  constexpr std::size_t kHigh = 16;
  const auto place = [](std::size_t row, std::size_t column) {
    return (row / 8 * 3 + column / 8) * kSquare + row % 8 * 8 + column % 8;
  };
  std::vector<std::vector<long double>> lines(kHigh);
  for (std::size_t row = 0; row < kHigh; ++row) {
    for (std::size_t column = 0; column < kWide; ++column) lines[row].push_back(values[place(row, column)]);
    lines[row] = verify::lapped_forward(lines[row], matrix_of(Angles::kTuned));
  }
  for (std::size_t column = 0; column < kWide; ++column) {
    std::vector<long double> line;
    for (std::size_t row = 0; row < kHigh; ++row) line.push_back(lines[row][column]);
    line = verify::lapped_forward(line, matrix_of(Angles::kStandard));
    for (std::size_t row = 0; row < kHigh; ++row) {
      EXPECT_NEAR(coefficients[place(row, column)], static_cast<double>(line[row]), 4e-6);
    }
  }
}

TEST(Lapped, FieldWithAHoleKeepsItsEnergyAndComesBack) {
  for (const bool whole : {true, false}) {
    const std::vector<Tile> field = tiles(whole);
    const std::vector<float> values = noise(field.size() * kSquare, 7);
    std::vector<float> work(values.size());
    std::vector<float> coefficients(values.size());
    std::vector<float> back(values.size());
    forward(field, values, Angles::kStandard, Angles::kTuned, work, coefficients);
    inverse(field, coefficients, Angles::kStandard, Angles::kTuned, work, back);
    double before = 0;
    double after = 0;
    for (std::size_t n = 0; n < values.size(); ++n) {
      EXPECT_NEAR(back[n], values[n], 4e-6);
      before += static_cast<double>(values[n]) * values[n];
      after += static_cast<double>(coefficients[n]) * coefficients[n];
    }
    EXPECT_NEAR(after / before, 1, 1e-6);
  }
}

TEST(Lapped, EveryInstructionSetGivesTheSameBits) {
  const std::vector<Tile> field = tiles(false);
  const std::vector<float> values = noise(field.size() * kSquare, 8);
  std::vector<float> work(values.size());
  std::vector<std::vector<float>> results;
  for (const auto level :
       {std::optional<SimdLevel>{}, std::optional{SimdLevel::kAvx2}, std::optional{SimdLevel::kBaseline}}) {
    voxelize::limit_simd(level);
    std::vector<float> coefficients(values.size());
    forward(field, values, Angles::kStandard, Angles::kTuned, work, coefficients);
    std::vector<float> line(values.size());
    forward(values, Angles::kTuned, line);
    coefficients.insert(coefficients.end(), line.begin(), line.end());
    results.push_back(coefficients);
  }
  voxelize::limit_simd({});
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
}

}  // namespace
}  // namespace footwall::extract::lapped
