#include "storage/formats/segy/decode.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <bit>
#include <cmath>
#include <random>
#include <vector>

#include "storage/formats/segy/samples.h"

namespace footwall::formats::segy {
namespace {

// Restricts Highway to the instruction sets of one target for as long as it lives.
class OnlyTarget {
 public:
  explicit OnlyTarget(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  ~OnlyTarget() {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  OnlyTarget(const OnlyTarget&) = delete;
  OnlyTarget& operator=(const OnlyTarget&) = delete;
};

std::vector<std::byte> random_bytes(std::size_t count) {
  std::mt19937 random(11);
  std::vector<std::byte> bytes(count);
  for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
  return bytes;
}

TEST(SegyDecode, EveryInstructionSetGivesTheSameBits) {
  constexpr std::size_t kCount = 4099;  // no multiple of any vector
  const std::vector<std::byte> in = random_bytes(kCount * 8 + 1);
  const std::int64_t supported = hwy::SupportedTargets();
  for (const int code : {1, 2, 3, 5, 6, 7, 8, 9, 10, 11, 12, 15, 16}) {
    for (const bool swap : {false, true}) {
      // One sample at a time leaves no room for vectors.
      const auto size = static_cast<std::size_t>(sample_format(code)->size);
      std::vector<std::uint32_t> expected;
      std::int64_t expected_beyond = 0;
      for (std::size_t n = 0; n < kCount; ++n) {
        float one = 0;
        expected_beyond += decode(code, swap, in.data() + 1 + n * size, {&one, 1});
        expected.push_back(std::bit_cast<std::uint32_t>(one));
      }
      for (std::int64_t target = 1; target > 0 && target <= supported; target <<= 1) {
        if ((target & supported) == 0) continue;
        const OnlyTarget only(target);
        std::vector<float> out(kCount);
        EXPECT_EQ(decode(code, swap, in.data() + 1, out), expected_beyond);
        for (std::size_t n = 0; n < kCount; ++n) {
          ASSERT_EQ(std::bit_cast<std::uint32_t>(out[n]), expected[n])
              << "format " << code << ", sample " << n << ", target " << target;
        }
      }
    }
  }
}

// Every exponent with fractions at the edges: what lies below 2^-126 rounds once, what lies above FLT_MAX is
// cut.
TEST(SegyDecode, IbmIsExactAtEveryExponent) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  std::vector<std::uint32_t> words;
  std::mt19937 random(5);
  for (std::uint32_t exponent = 0; exponent < 128; ++exponent) {
    for (const std::uint32_t fraction :
         {0U, 1U, 2U, 3U, 0x7FFFFFU, 0x800000U, 0x800001U, 0xFFFFFEU, 0xFFFFFFU,
          static_cast<std::uint32_t>(random()) >> 8, static_cast<std::uint32_t>(random()) >> 16}) {
      words.push_back(exponent << 24 | fraction);
      words.push_back(0x80000000U | exponent << 24 | fraction);
    }
  }
  std::vector<float> out(words.size());
  std::int64_t over = 0;
  const std::int64_t beyond = decode(1, false, reinterpret_cast<const std::byte*>(words.data()), out);
  for (std::size_t n = 0; n < words.size(); ++n) {
    const double exact = std::ldexp(static_cast<double>(words[n] & 0xFFFFFFU),
                                    4 * static_cast<int>(words[n] >> 24 & 0x7FU) - 280);
    over += exact > kLargest ? 1 : 0;
    const auto nearest = static_cast<float>(std::min(exact, kLargest));
    EXPECT_EQ(std::bit_cast<std::uint32_t>(out[n]),
              std::bit_cast<std::uint32_t>(nearest) | (words[n] & 0x80000000U))
        << std::hex << words[n];
  }
  EXPECT_EQ(beyond, over);
  EXPECT_GT(over, 0);
}

}  // namespace
}  // namespace footwall::formats::segy
