#include "storage/formats/segy/samples.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace footwall::formats::segy {
namespace {

constexpr float kLargest = std::numeric_limits<float>::max();

std::vector<std::byte> bytes(std::initializer_list<int> values) {
  std::vector<std::byte> out;
  for (const int value : values) out.push_back(static_cast<std::byte>(value));
  return out;
}

float first_of(int code, std::initializer_list<int> in, bool little = false, std::int64_t* beyond = nullptr) {
  const auto data = bytes(in);
  float out = 0;
  const SampleFormat* format = sample_format(code);
  EXPECT_EQ(static_cast<std::size_t>(format->size), data.size());
  const auto count = (little ? format->decode_little : format->decode_big)(data.data(), {&out, 1});
  if (beyond != nullptr) *beyond = count;
  return out;
}

TEST(SegySamples, IbmVectorsAreExactAlsoUnnormalised) {
  EXPECT_EQ(ibm_to_float(0x41100000u), 1.0f);
  EXPECT_EQ(ibm_to_float(0x42640000u), 100.0f);
  EXPECT_EQ(ibm_to_float(0xC276A000u), -118.625f);
  EXPECT_EQ(ibm_to_float(0x41080000u), 0.5f);
  EXPECT_EQ(ibm_to_float(0x41000001u), 0x1p-20f);
  EXPECT_EQ(ibm_to_float(0), 0.0f);
  EXPECT_TRUE(std::signbit(ibm_to_float(0x80000000u)));
  EXPECT_EQ(ibm_to_float(0x7F000000u), 0.0f);
}

TEST(SegySamples, IbmEqualsTheDefinitionForRandomBits) {
  std::mt19937 random(7);
  for (int n = 0; n < 200000; ++n) {
    const std::uint32_t bits = random();
    const double exact =
        std::ldexp(static_cast<double>(bits & 0xFFFFFFu), 4 * static_cast<int>(bits >> 24 & 0x7F) - 280) *
        (bits >> 31 ? -1 : 1);
    const std::uint32_t big = __builtin_bswap32(bits);
    float decoded = 0;
    const auto beyond = sample_format(1)->decode_big(reinterpret_cast<const std::byte*>(&big), {&decoded, 1});
    if (std::fabs(exact) > kLargest) {
      ASSERT_EQ(decoded, std::copysign(kLargest, static_cast<float>(exact > 0 ? 1 : -1))) << std::hex << bits;
      ASSERT_EQ(beyond, 1);
    } else {
      ASSERT_EQ(decoded, static_cast<float>(exact)) << std::hex << bits;
      ASSERT_EQ(beyond, 0);
    }
  }
}

TEST(SegySamples, WhatFloatCannotHoldSaturatesAndIsCounted) {
  std::int64_t beyond = 0;
  EXPECT_EQ(first_of(1, {0x7F, 0xFF, 0xFF, 0xFF}, false, &beyond), kLargest);
  EXPECT_EQ(beyond, 1);
  EXPECT_EQ(first_of(1, {0xE1, 0x10, 0x00, 0x01}, false, &beyond), -kLargest);
  EXPECT_EQ(beyond, 1);
  EXPECT_EQ(first_of(1, {0x60, 0xFF, 0xFF, 0xFF}, false, &beyond), kLargest);  // exactly FLT_MAX
  EXPECT_EQ(beyond, 0);
  EXPECT_EQ(first_of(6, {0x7F, 0xE0, 0, 0, 0, 0, 0, 0}, false, &beyond), kLargest);
  EXPECT_EQ(beyond, 1);
  EXPECT_TRUE(std::isinf(first_of(6, {0x7F, 0xF0, 0, 0, 0, 0, 0, 0}, false, &beyond)));
  EXPECT_EQ(beyond, 0);
}

TEST(SegySamples, EveryFormatInBothByteOrders) {
  EXPECT_EQ(first_of(2, {0xFF, 0xFF, 0xFF, 0x85}), -123.0f);
  EXPECT_EQ(first_of(2, {0x85, 0xFF, 0xFF, 0xFF}, true), -123.0f);
  EXPECT_EQ(first_of(3, {0x80, 0x00}), -32768.0f);
  EXPECT_EQ(first_of(3, {0x00, 0x80}, true), -32768.0f);
  EXPECT_EQ(first_of(5, {0xC2, 0xED, 0x40, 0x00}), -118.625f);
  EXPECT_EQ(first_of(5, {0x00, 0x40, 0xED, 0xC2}, true), -118.625f);
  EXPECT_EQ(first_of(6, {0xC0, 0x5D, 0xA8, 0, 0, 0, 0, 0}), -118.625f);
  EXPECT_EQ(first_of(7, {0xFF, 0xFF, 0xFE}), -2.0f);
  EXPECT_EQ(first_of(7, {0xFE, 0xFF, 0xFF}, true), -2.0f);
  EXPECT_EQ(first_of(8, {0x80}), -128.0f);
  EXPECT_EQ(first_of(9, {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x00}), -256.0f);
  EXPECT_EQ(first_of(10, {0xFF, 0xFF, 0xFF, 0xFF}), 4294967296.0f);
  EXPECT_EQ(first_of(11, {0xFF, 0xFE}), 65534.0f);
  EXPECT_EQ(first_of(12, {0, 0, 1, 0, 0, 0, 0, 0}), 1099511627776.0f);
  EXPECT_EQ(first_of(15, {0xFF, 0xFF, 0xFE}), 16777214.0f);
  EXPECT_EQ(first_of(16, {0xFF}), 255.0f);
}

TEST(SegySamples, CodesThatCannotBeReadHaveNoRow) {
  for (const int code : {-1, 0, 4, 13, 14, 17, 256}) EXPECT_EQ(sample_format(code), nullptr) << code;
  EXPECT_TRUE(is_defined_format(4));
  EXPECT_FALSE(is_defined_format(13));
}

}  // namespace
}  // namespace footwall::formats::segy
