#include "storage/formats/segy/segy_writer.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "scratch_folder.h"
#include "storage/base/error.h"
#include "storage/formats/segy/samples.h"
#include "storage/formats/segy/segy_file.h"

namespace footwall::formats::segy {
namespace {

survey::Geometry sample_geometry() {
  survey::Geometry g;
  g.inlines = {-3, 2, 4};
  g.crosslines = {1001, 5, 5};
  g.samples = 7;
  g.z0 = 812.5;
  g.interval = 4;
  g.map = {458123.37, 6785432.12, 11.2, 5.3, -4.7, 9.9};
  g.crs = "EPSG:23031 & <caf\xC3\xA9>";
  return g;
}

float value_at(std::int64_t i, std::int64_t j, std::int64_t k) {
  return static_cast<float>(std::exp(0.7 * double(i) - double(j)) * (k % 2 != 0 ? -1.1 : 0.9) * double(k));
}

void fill(const survey::Box& box, std::span<float> values) {
  std::size_t n = 0;
  for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
    for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
      for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) values[n++] = value_at(i, j, k);
    }
  }
}

std::int64_t number_at(const std::string& bytes, std::size_t byte, std::size_t size) {
  std::uint64_t bits = 0;
  for (std::size_t n = 0; n < size; ++n) bits = bits << 8 | static_cast<unsigned char>(bytes[byte - 1 + n]);
  if (size == 2) return static_cast<std::int16_t>(bits);
  return size == 4 ? static_cast<std::int32_t>(bits) : static_cast<std::int64_t>(bits);
}

TEST(SegyWriter, ReadsBackTheSameBitsAndTheSameSurvey) {
  const ScratchFolder folder;
  const survey::Geometry g = sample_geometry();
  std::vector<std::uint8_t> live(20, 1);
  live[0] = live[7] = live[19] = 0;  // corners too
  for (const Holes holes : {Holes::kSkip, Holes::kDead}) {
    WriteOptions options;
    options.holes = holes;
    const Written written = write(folder / "a.sgy", g, live, fill, 2, options);
    EXPECT_EQ(written.traces, holes == Holes::kSkip ? 17 : 20);
    EXPECT_EQ(written.dead + written.skipped, 3);
    EXPECT_EQ(written.revision, 1);
    EXPECT_EQ(written.coordinate_scalar, -100);  // 6,785,432 in thousandths leaves 32 bits
    ASSERT_EQ(written.notes.size(), 1u);

    const SegyFile file = SegyFile::scan(folder / "a.sgy", {});
    const survey::Geometry& back = file.geometry();
    EXPECT_EQ(back.inlines, g.inlines);
    EXPECT_EQ(back.crosslines, g.crosslines);
    EXPECT_EQ(back.samples, g.samples);
    EXPECT_EQ(back.z0, g.z0);
    EXPECT_EQ(back.interval, g.interval);
    for (const double i : {0.0, 3.0}) {
      for (const double j : {0.0, 4.0}) {
        EXPECT_NEAR(back.world_of({i, j, 0}).x, g.world_of({i, j, 0}).x, 0.01);
        EXPECT_NEAR(back.world_of({i, j, 0}).y, g.world_of({i, j, 0}).y, 0.01);
      }
    }
    EXPECT_TRUE(file.report().warnings.empty()) << file.report().warnings[0];
    std::vector<float> values(4 * 5 * 7);
    std::vector<std::uint8_t> mask(20, 1);
    file.read_block(g.box(), values, mask);
    EXPECT_EQ(mask, live);
    std::vector<float> wanted(values.size());
    fill(g.box(), wanted);
    for (std::size_t n = 0; n < values.size(); ++n) {
      if (live[n / 7] != 0) {
        ASSERT_EQ(std::bit_cast<std::uint32_t>(values[n]), std::bit_cast<std::uint32_t>(wanted[n])) << n;
      }
    }
  }
}

TEST(SegyWriter, FillsTheWordsThatOtherProgramsRead) {
  const ScratchFolder folder;
  const survey::Geometry g = sample_geometry();
  write(folder / "a.sgy", g, std::vector<std::uint8_t>(20, 1), fill, 32, {});
  const std::string bytes = content_of(folder / "a.sgy");
  const std::size_t trace_size = 240 + 7 * 4;
  ASSERT_EQ(bytes.size(), 3600 + 20 * trace_size);
  EXPECT_EQ(number_at(bytes, 3217, 2), 4000);
  EXPECT_EQ(number_at(bytes, 3221, 2), 7);
  EXPECT_EQ(number_at(bytes, 3225, 2), 5);
  EXPECT_EQ(number_at(bytes, 3255, 2), 1);
  EXPECT_EQ(number_at(bytes, 3501, 2), 0x0100);
  EXPECT_EQ(number_at(bytes, 3503, 2), 1);
  const std::size_t trace = 3600 + 13 * trace_size;  // i = 2, j = 3
  const auto word = [&](std::size_t byte) { return number_at(bytes, trace + byte, 4); };
  const auto half = [&](std::size_t byte) { return number_at(bytes, trace + byte, 2); };
  const survey::WorldPoint at = g.world_of({2, 3, 0});
  EXPECT_EQ(word(1), 4);
  EXPECT_EQ(word(5), 14);
  EXPECT_EQ(word(21), 1016);
  EXPECT_EQ(half(29), 1);
  EXPECT_EQ(word(37), 0);
  EXPECT_EQ(half(71), -100);
  EXPECT_EQ(word(73), std::llround(at.x * 100));
  EXPECT_EQ(word(77), std::llround(at.y * 100));
  EXPECT_EQ(half(109), 8125);
  EXPECT_EQ(half(115), 7);
  EXPECT_EQ(half(117), 4000);
  EXPECT_EQ(word(181), word(73));
  EXPECT_EQ(word(185), word(77));
  EXPECT_EQ(word(189), 1);
  EXPECT_EQ(word(193), 1016);
  EXPECT_EQ(half(215), -10);
}

TEST(SegyWriter, TheTextTellsTheSurvey) {
  const ScratchFolder folder;
  WriteOptions options;
  options.title = "amplitude of a.footwall";
  write(folder / "a.sgy", sample_geometry(), std::vector<std::uint8_t>(20, 1), fill, 32, options);
  const SegyFile file = SegyFile::scan(folder / "a.sgy", {});
  EXPECT_TRUE(file.report().text_is_ebcdic);
  const auto& lines = file.report().text_header;
  ASSERT_EQ(lines.size(), 40u);
  for (std::size_t n = 0; n < 40; ++n) EXPECT_EQ(lines[n].substr(0, 3), fmt::format("C{:2}", n + 1));
  const std::string text = fmt::format("{}", fmt::join(lines, "\n"));
  for (const char* part :
       {"amplitude of a.footwall", "INLINES    -3 to 3 by 2", "time, z positive down, in ms",
        "CRS EPSG:23031", "X 458123.370 Y 6785432.120", "SEG Y REV1", "END TEXTUAL HEADER"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
}

TEST(SegyWriter, CoordinatesKeepThousandthsWhereTheyFit) {
  const ScratchFolder folder;
  survey::Geometry g = sample_geometry();
  g.map.origin_x = 1234.5674;
  g.map.origin_y = -2000000.001;
  EXPECT_EQ(write(folder / "a.sgy", g, std::vector<std::uint8_t>(20, 1), fill, 1, {}).coordinate_scalar,
            -1000);
  g.map.origin_x = 5e9;  // beyond 32 bits even in whole units
  const Written far = write(folder / "b.sgy", g, std::vector<std::uint8_t>(20, 1), fill, 1, {});
  EXPECT_EQ(far.coordinate_scalar, 10);
  EXPECT_FALSE(far.notes.empty());
  EXPECT_NEAR(SegyFile::scan(folder / "b.sgy", {}).geometry().map.origin_x, 5e9, 10);
}

TEST(SegyWriter, WhatRevisionOneCannotHoldGoesIntoRevisionTwo) {
  const ScratchFolder folder;
  survey::Geometry g = sample_geometry();
  g.interval = 4.0 / 3;
  g.z0 = -120;
  const Written odd = write(folder / "a.sgy", g, std::vector<std::uint8_t>(20, 1), fill, 1, {});
  EXPECT_EQ(odd.revision, 2);
  EXPECT_EQ(odd.notes.size(), 2u);
  const SegyFile back = SegyFile::scan(folder / "a.sgy", {});
  EXPECT_DOUBLE_EQ(back.geometry().interval, g.interval);
  EXPECT_EQ(back.geometry().z0, -120);
  EXPECT_EQ(back.report().traces, 20);

  g = sample_geometry();
  g.inlines.count = g.crosslines.count = 1;
  const auto ramp = [](const survey::Box&, std::span<float> values) {
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = static_cast<float>(k);
  };
  for (const std::int64_t samples : {32767, 32768, 65535, 65536, 100001}) {
    g.samples = samples;
    const Written written = write(folder / "long.sgy", g, std::vector<std::uint8_t>(1, 1), ramp, 1, {});
    EXPECT_EQ(written.revision, samples > 65535 ? 2 : 1);
    const SegyFile file = SegyFile::scan(folder / "long.sgy", {});
    ASSERT_EQ(file.geometry().samples, samples);
    std::vector<float> values(static_cast<std::size_t>(samples));
    std::vector<std::uint8_t> live(1, 1);
    file.read_block(file.geometry().box(), values, live);
    EXPECT_EQ(values.back(), static_cast<float>(samples - 1));
  }
}

TEST(SegyWriter, NullsAreNotNumbersUnlessAsked) {
  const ScratchFolder folder;
  const survey::Geometry g = sample_geometry();
  const auto holes = [](const survey::Box& box, std::span<float> values) {
    fill(box, values);
    values[3] = std::numeric_limits<float>::quiet_NaN();
  };
  const auto read_back = [&](const WriteOptions& options) {
    const Written written = write(folder / "a.sgy", g, std::vector<std::uint8_t>(20, 1), holes, 99, options);
    EXPECT_EQ(written.nulls, 1);
    std::vector<float> values(7);
    std::vector<std::uint8_t> live(1, 1);
    SegyFile::scan(folder / "a.sgy", {}).read_block({{0, 0, 0}, {1, 1, 7}}, values, live);
    return values[3];
  };
  WriteOptions options;
  EXPECT_TRUE(std::isnan(read_back(options)));
  options.format = 1;
  EXPECT_EQ(read_back(options), 0);
  options.null_value = -999.25F;
  EXPECT_EQ(read_back(options), -999.25F);
}

TEST(SegyWriter, RefusesWhatMakesNoFile) {
  const ScratchFolder folder;
  WriteOptions options;
  options.format = 3;
  EXPECT_THROW(write(folder / "a.sgy", sample_geometry(), std::vector<std::uint8_t>(20, 1), fill, 1, options),
               Error);
  EXPECT_THROW(write(folder / "a.sgy", sample_geometry(), std::vector<std::uint8_t>(20, 0), fill, 1, {}),
               Error);
  const JobContext job;
  job.cancel();
  EXPECT_THROW(write(folder / "a.sgy", sample_geometry(), std::vector<std::uint8_t>(20, 1), fill, 1, {}, job),
               Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

// The definition: no IBM number is nearer; of two as near the one with the even fraction.
void expect_nearest(float value) {
  const std::uint32_t bits = ibm_from_float(value);
  const auto exact = [](std::uint32_t ibm) {
    const double fraction = static_cast<double>(ibm & 0xFFFFFF) / 16777216;
    const double size = std::ldexp(fraction, 4 * (static_cast<int>((ibm >> 24) & 0x7F) - 64));
    return (ibm >> 31) != 0 ? -size : size;
  };
  const double wanted = static_cast<double>(value);
  const double error = std::abs(exact(bits) - wanted);
  ASSERT_EQ(bits >> 31, std::bit_cast<std::uint32_t>(value) >> 31) << value;
  if (value == 0) {
    ASSERT_EQ(bits & 0x7FFFFFFF, 0u);
    return;
  }
  ASSERT_GE(bits & 0xFFFFFF, 0x100000u) << value << " is not normalised";
  for (const std::uint32_t other : {bits - 1, bits + 1}) {
    if ((other & 0xFFFFFF) < 0x100000u) continue;  // left the exponent
    const double distance = std::abs(exact(other) - wanted);
    ASSERT_LE(error, distance) << value;
    if (error == distance) {
      ASSERT_EQ(bits & 1, 0u) << value;
    }
  }
}

TEST(SegyWriter, IbmNumbersAreTheNearest) {
  EXPECT_EQ(ibm_from_float(1), 0x41100000u);
  EXPECT_EQ(ibm_from_float(100), 0x42640000u);
  EXPECT_EQ(ibm_from_float(-118.625F), 0xC276A000u);
  EXPECT_EQ(ibm_from_float(0), 0u);
  std::mt19937 random(11);
  for (int n = 0; n < 200000; ++n) {
    const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    if (std::isfinite(value)) expect_nearest(value);
  }
  using Limits = std::numeric_limits<float>;
  for (const float value :
       {Limits::max(), Limits::lowest(), Limits::min(), Limits::denorm_min(), -0.0F, 0.0F,
        Limits::denorm_min() * 3, 16777215.0F, 0x1.FFFFFEp-1F, 0x1.FFFFFEp0F, 0x1.000002p2F}) {
    expect_nearest(value);
  }
  // And back through the reader: exact where the fraction has bits to spare.
  for (int n = 0; n < 100000; ++n) {
    const float value = static_cast<float>(static_cast<std::int32_t>(random()) >> 11) / 1024;  // 21 bits
    ASSERT_EQ(ibm_to_float(ibm_from_float(value)), value);
  }
}

}  // namespace
}  // namespace footwall::formats::segy
