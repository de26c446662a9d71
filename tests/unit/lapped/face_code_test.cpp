#include "engine/extract/lapped/face_code.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "engine/extract/lapped/band_coder.h"
#include "engine/verify/lapped_by_definition.h"
#include "engine/voxelize/simd.h"
#include "storage/base/error.h"

namespace footwall::extract::lapped {
namespace {

constexpr float kNull = std::numeric_limits<float>::quiet_NaN();

// A triangle of columns of 1 to `longest` voxels.
Columns triangle(std::int64_t side, std::int32_t longest, unsigned seed = 1) {
  std::mt19937 random(seed);
  Columns columns;
  for (std::int64_t v = 0; v < side; ++v) {
    for (std::int64_t u = v / 2; u < side - v / 3; ++u) {
      columns.add(u - 20, v + 7, 1 + static_cast<std::int32_t>(random() % static_cast<unsigned>(longest)));
    }
  }
  return columns;
}

// Smooth along u and v, alike along a column.
std::vector<float> values_of(const Columns& columns, float noise, unsigned seed = 2) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal(0, noise);
  std::vector<float> values;
  for (const ColumnRow& row : columns.rows) {
    for (std::size_t n = 0; n < row.count; ++n) {
      const double u = static_cast<double>(row.u) + static_cast<double>(n);
      const auto smooth =
          static_cast<float>(3 * std::sin(u / 2) * std::cos(static_cast<double>(row.v) / 9) + 0.5);
      for (std::int32_t w = 0; w < columns.lengths[row.first + n]; ++w) {
        values.push_back(smooth + 0.2F * static_cast<float>(w) + normal(random));
      }
    }
  }
  return values;
}

std::vector<std::byte> encoded(const Coding& coding, const Columns& columns, std::span<const float> values) {
  FaceEncoder encoder(coding);
  std::vector<std::byte> code;
  encoder.encode(columns, values, code);
  return code;
}

std::vector<float> decoded(std::span<const std::byte> code, const Columns& columns) {
  FaceDecoder decoder;
  std::vector<float> values(static_cast<std::size_t>(columns.voxels), -77.0F);
  decoder.decode(code, columns, values);
  return values;
}

double snr_of(std::span<const float> values, std::span<const float> back) {
  double mean = 0;
  double count = 0;
  for (const float value : values) {
    if (!std::isfinite(value)) continue;
    mean += value;
    ++count;
  }
  mean /= count;
  double signal = 0;
  double noise = 0;
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (!std::isfinite(values[n])) continue;
    signal += (values[n] - mean) * (values[n] - mean);
    noise += (static_cast<double>(values[n]) - back[n]) * (static_cast<double>(values[n]) - back[n]);
  }
  return 10 * std::log10(signal / noise);
}

std::vector<Coding> codings(double snr_db) {
  std::vector<Coding> all;
  for (const Order order : {Order::kLine, Order::kRaster}) {
    for (const Ends ends : {Ends::kMirrored, Ends::kZero}) {
      for (const Angles angles : {Angles::kStandard, Angles::kTuned}) {
        all.push_back({snr_db, order, angles, Angles::kStandard, ends});
      }
    }
  }
  return all;
}

TEST(FaceCode, ReachesTheRatioAskedForInFewerBytes) {
  for (const std::int32_t longest : {1, 2, 3, 4}) {
    const Columns columns = triangle(60, longest);
    for (const float noise : {0.1F, 5.0F}) {
      const std::vector<float> values = values_of(columns, noise);
      std::size_t former = 0;
      for (const double snr : {20.0, 30.0, 50.0, 70.0}) {
        for (const Coding& coding : codings(snr)) {
          const std::vector<std::byte> code = encoded(coding, columns, values);
          EXPECT_NEAR(snr_of(values, decoded(code, columns)), snr, 0.6) << longest << ' ' << noise;
          EXPECT_LT(code.size(), values.size() * 3);
          if (coding == codings(snr).back()) {
            EXPECT_GT(code.size(), former);
            former = code.size();
          }
        }
      }
    }
  }
}

TEST(FaceCode, PicturesOfSmoothFacesTakeFewerBytesThanLines) {
  const Columns columns = triangle(60, 1);
  const std::vector<float> values = values_of(columns, 0.05F);
  const std::size_t line = encoded({30, Order::kLine}, columns, values).size();
  const std::size_t raster = encoded({30, Order::kRaster}, columns, values).size();
  EXPECT_LT(raster, line * 3 / 4) << line;
}

TEST(FaceCode, SizesOfEveryKindComeBack) {
  for (std::int32_t n = 0; n <= 70; ++n) {
    Columns columns;
    for (std::int32_t u = 0; u < n; ++u) columns.add(u, 0, 1);
    const std::vector<float> values = values_of(columns, 1, static_cast<unsigned>(n));
    for (const Coding& coding : codings(40)) {
      const std::vector<float> back = decoded(encoded(coding, columns, values), columns);
      for (std::size_t v = 0; v < values.size(); ++v) EXPECT_NEAR(back[v], values[v], 0.4) << n;
    }
  }
}

TEST(FaceCode, ColumnsTooLongForAPictureAndGapsComeBack) {
  Columns columns;
  columns.add(0, 0, 900);
  columns.add(1, 0, 0);
  columns.add(2, 0, 3);
  columns.add(1000000, 40, 2);
  columns.add(-1000000, 41, 2);
  const std::vector<float> values = values_of(columns, 0.2F);
  EXPECT_NEAR(snr_of(values, decoded(encoded({40}, columns, values), columns)), 40, 1.5);
  // The same without the long one: a picture of three far tiles.
  Columns far = triangle(40, 2);
  far.add(1000000, 400, 2);
  const std::vector<float> others = values_of(far, 0.2F);
  EXPECT_NEAR(snr_of(others, decoded(encoded({40}, far, others), far)), 40, 1);
}

TEST(FaceCode, NullsComeBackAsNullsAndCostLittle) {
  const Columns columns = triangle(60, 2);
  const std::vector<float> whole = values_of(columns, 0.1F);
  for (const Coding& coding : codings(30)) {
    std::vector<float> values = whole;
    std::fill_n(values.begin(), 9, kNull);
    std::fill_n(values.begin() + 400, 33, std::numeric_limits<float>::infinity());
    values[777] = kNull;
    values.back() = kNull;
    const std::vector<std::byte> code = encoded(coding, columns, values);
    const std::vector<float> back = decoded(code, columns);
    for (std::size_t n = 0; n < values.size(); ++n) {
      ASSERT_EQ(std::isnan(back[n]), !std::isfinite(values[n])) << n;
    }
    EXPECT_NEAR(snr_of(values, back), 30, 0.6);
    EXPECT_LT(code.size(), encoded(coding, columns, whole).size() + 60);
  }
}

TEST(FaceCode, FacesThatHaveNoWavesAreExact) {
  const Columns columns = triangle(9, 2);
  const auto n = static_cast<std::size_t>(columns.voxels);
  const float subnormal = std::numeric_limits<float>::denorm_min();
  std::vector<std::vector<float>> faces{std::vector<float>(n, 3.25F), std::vector<float>(n, kNull),
                                        std::vector<float>(n, 0.0F), std::vector<float>(n, subnormal)};
  faces[3][4] = 0;
  faces.push_back(faces[0]);
  faces.back()[3] = kNull;
  for (const std::vector<float>& values : faces) {
    for (const Coding& coding : codings(30)) {
      const std::vector<std::byte> code = encoded(coding, columns, values);
      const std::vector<float> back = decoded(code, columns);
      for (std::size_t v = 0; v < n; ++v) {
        EXPECT_TRUE(back[v] == values[v] || (std::isnan(back[v]) && std::isnan(values[v])));
      }
    }
  }
  EXPECT_LE(encoded({30}, columns, faces[0]).size(), 5U);
}

TEST(FaceCode, AnyScaleAndPedestalKeepsTheRatio) {
  const Columns columns = triangle(40, 2);
  const std::vector<float> unit = values_of(columns, 1);
  for (const float scale : {1e-30F, 1e-3F, 1.0F, 1e20F, 1e37F}) {
    for (const float pedestal : {0.0F, 1.0F, -300.0F}) {
      std::vector<float> values = unit;
      for (float& value : values) value = (value * 0.1F + pedestal) * (scale / 10);
      for (const Order order : {Order::kLine, Order::kRaster}) {
        const std::vector<float> back = decoded(encoded({30, order}, columns, values), columns);
        EXPECT_NEAR(snr_of(values, back), 30, 0.6) << scale << ' ' << pedestal;
      }
    }
  }
}

TEST(FaceCode, OneSpikeAmongZerosComesBack) {
  const Columns columns = triangle(60, 2);
  std::vector<float> values(static_cast<std::size_t>(columns.voxels), 0);
  values[1000] = 1e6F;
  for (const Coding& coding : codings(60)) {
    EXPECT_GT(snr_of(values, decoded(encoded(coding, columns, values), columns)), 58.5);
  }
}

TEST(FaceCode, BytesDoNotDependOnTheInstructionSetOrOnFormerFaces) {
  const Columns columns = triangle(50, 3);
  const Columns other = triangle(33, 1, 9);
  const std::vector<float> values = values_of(columns, 0.3F);
  const std::vector<float> others = values_of(other, 0.3F);
  for (const Coding& coding : codings(35)) {
    const std::vector<std::byte> expected = encoded(coding, columns, values);
    const std::vector<float> back = decoded(expected, columns);
    for (const SimdLevel level : {SimdLevel::kBaseline, SimdLevel::kAvx2}) {
      voxelize::limit_simd(level);
      FaceEncoder encoder(coding);
      std::vector<std::byte> before;
      encoder.encode(other, others, before);
      std::vector<std::byte> code;
      encoder.encode(columns, values, code);
      EXPECT_EQ(code, expected);
      EXPECT_EQ(decoded(code, columns), back);
      voxelize::limit_simd({});
    }
  }
}

TEST(FaceCode, DecoderInvertsByTheDefinition) {
  // A line whose coefficients are read out of the code, and put back by the matrix product.
  Columns columns;
  for (std::int64_t u = 0; u < 40; ++u) columns.add(u, 0, 1);
  const std::vector<float> values = values_of(columns, 1);
  const std::vector<std::byte> code = encoded({30, Order::kLine}, columns, values);
  ASSERT_EQ(std::to_integer<int>(code[0]), 1);  // a line without an offset
  std::uint16_t step_bits = 0;
  std::memcpy(&step_bits, code.data() + 1, 2);
  const std::uint32_t bits = std::uint32_t{step_bits} << 15;
  float step = 0;
  std::memcpy(&step, &bits, 4);
  BandDecoder bands(std::span<const std::byte>(code).subspan(3));
  std::vector<std::int32_t> quantized(40);
  bands.read_line(quantized);
  bands.end();
  const std::vector<long double> back =
      verify::lapped_inverse(std::vector<long double>(quantized.begin(), quantized.end()),
                             verify::lapped_matrix({0.13L, 0.16L, 0.13L}));
  const std::vector<float> found = decoded(code, columns);
  for (std::size_t n = 0; n < found.size(); ++n) {
    EXPECT_NEAR(found[n], static_cast<double>(back[n] * step), 1e-5 * step * 30);
  }
}

TEST(FaceCode, DamagedBytesAreRefusedOrDecodeWithoutHarm) {
  const Columns columns = triangle(30, 2);
  std::vector<float> values = values_of(columns, 0.3F);
  values[100] = kNull;
  std::mt19937 random(3);
  int refused = 0;
  for (const Coding& coding : codings(30)) {
    const std::vector<std::byte> whole = encoded(coding, columns, values);
    for (int round = 0; round < 60; ++round) {
      std::vector<std::byte> code = whole;
      if (round % 3 == 0) code.resize(random() % code.size());
      for (int change = 0; change <= round % 4 && !code.empty(); ++change) {
        code[random() % code.size()] ^= static_cast<std::byte>(1U << random() % 8);
      }
      try {
        decoded(code, columns);
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kCorrupt);
        ++refused;
      }
    }
    EXPECT_THROW(decoded(whole, triangle(31, 2)), Error);
  }
  EXPECT_GT(refused, 300);
}

TEST(FaceCode, RatiosThatCannotBeAreRefused) {
  for (const double snr : {0.0, -3.0, 101.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(FaceEncoder({snr}), Error) << snr;
  }
}

}  // namespace
}  // namespace footwall::extract::lapped
