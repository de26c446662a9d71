#include "engine/extract/statistics/partial.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>

#include "storage/base/error.h"

namespace footwall::extract {
namespace {

void expect_same(const Partial& a, const Partial& b) {
  EXPECT_EQ(a.moments.count, b.moments.count);
  EXPECT_EQ(a.moments.nulls, b.moments.nulls);
  EXPECT_EQ(a.moments.sum, b.moments.sum);
  EXPECT_EQ(a.moments.squares, b.moments.squares);
  EXPECT_EQ(a.moments.min, b.moments.min);
  EXPECT_EQ(a.moments.max, b.moments.max);
  EXPECT_TRUE(a.discontinuity.num == b.discontinuity.num);
  EXPECT_TRUE(a.discontinuity.den == b.discontinuity.den);
}

TEST(Partial, ReadsBackAsItWasWritten) {
  std::mt19937_64 random(3);
  std::vector<std::byte> bytes;
  std::vector<Partial> partials;
  for (int n = 0; n < 500; ++n) {
    Partial partial;
    std::vector<float> values(random() % 5 == 0 ? 0 : random() % 40);
    for (float& value : values) value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    fold(values, partial.moments);
    if (n % 2 == 0) {
      partial.discontinuity.den = (static_cast<Int128>(random() >> 2) << (random() % 60)) + 1;
      partial.discontinuity.num = partial.discontinuity.den / static_cast<std::int64_t>(1 + random() % 9);
    }
    encode(n * 1000003LL, partial, bytes);
    partials.push_back(partial);
  }
  std::span<const std::byte> rest(bytes);
  for (int n = 0; n < 500; ++n) {
    Partial read;
    EXPECT_EQ(decode(rest, read), n * 1000003LL);
    expect_same(read, partials[static_cast<std::size_t>(n)]);
  }
  EXPECT_TRUE(rest.empty());
}

TEST(Partial, IsCompactForSeismicAmplitudes) {
  std::mt19937_64 random(5);
  std::normal_distribution<float> normal;
  std::vector<float> values(800);
  for (float& value : values) value = 5000 * normal(random);
  Partial partial;
  fold(values, partial.moments);
  std::vector<std::byte> bytes;
  encode(123456, partial, bytes);
  EXPECT_LE(bytes.size(), 60U);
}

TEST(Partial, ACutRecordIsRefused) {
  Partial partial;
  fold(std::vector<float>{1, -2, 3.5F}, partial.moments);
  partial.discontinuity.den = 99;
  std::vector<std::byte> bytes;
  encode(7, partial, bytes);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    std::span<const std::byte> cut(bytes.data(), size);
    Partial read;
    EXPECT_THROW(decode(cut, read), Error) << size;
  }
}

}  // namespace
}  // namespace footwall::extract
