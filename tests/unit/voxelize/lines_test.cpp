#include "engine/voxelize/detail/lines.h"

#include <gtest/gtest.h>

#include <vector>

#include "unit/voxelize/triangles.h"

namespace footwall::voxelize::detail {
namespace {

std::int64_t value_of(const FixedLine& fixed, std::int64_t x) {
  const auto grown = static_cast<std::uint64_t>(fixed.base) +
                     static_cast<std::uint64_t>(fixed.slope) * static_cast<std::uint64_t>(x - fixed.x_mid);
  return fixed.y_ref + (static_cast<std::int64_t>(grown) >> fixed.shift);
}

// Fixed point is either exact or refuses; it must not refuse what ordinary triangles bring.
TEST(Lines, FixedPointIsExactWhereverItIsUsed) {
  Numbers numbers(21);
  int used = 0;
  for (int round = 0; round < 3000; ++round) {
    Line line;
    const std::int64_t most = std::int64_t{1} << numbers.within(1, 32);
    line.d = numbers.next() % static_cast<std::uint64_t>(most) + 1;
    line.a = static_cast<std::int64_t>(numbers.next() % static_cast<std::uint64_t>(2 * most)) - most;
    line.c = static_cast<std::int64_t>(numbers.next() >> numbers.within(16, 60));
    const std::int64_t first = numbers.within(-3000, 3000);
    const std::int64_t count = numbers.within(1, 2048);
    FixedLine fixed;
    if (!to_fixed(line, first, count, fixed)) continue;
    ++used;
    for (std::int64_t x = first; x < first + count; ++x) {
      const auto exact = floor_div(static_cast<Int128>(line.a) * x + line.c, Int128{line.d});
      ASSERT_EQ(value_of(fixed, x), static_cast<std::int64_t>(exact))
          << line.a << " " << line.c << " " << line.d;
    }
  }
  EXPECT_GT(used, 1000);
  FixedLine fixed;
  EXPECT_TRUE(to_fixed({true, (1 << 19) - 1, 12345, 1}, -1024, 2048, fixed));
}

TEST(Lines, SteppingEqualsDividing) {
  Numbers numbers(22);
  for (int round = 0; round < 500; ++round) {
    const std::int64_t most = std::int64_t{1} << numbers.within(1, 32);
    const Line line = {numbers.next() % 2 == 0, numbers.within(-most / 2, most / 2 - 1),
                       static_cast<std::int64_t>(numbers.next() >> 20), numbers.within(0, most / 2 - 1) + 1};
    const std::int64_t first = numbers.within(-8388608, 8388607);
    std::vector<std::int32_t> lo(100, -1 << 23);
    std::vector<std::int32_t> hi(100, 1 << 23);
    tighten(line, first, lo, hi);
    for (std::int64_t n = 0; n < 100; ++n) {
      const Int128 exact = floor_div(static_cast<Int128>(line.a) * (first + n) + line.c, Int128{line.d});
      if (line.upper) {
        ASSERT_EQ(hi[n],
                  static_cast<std::int32_t>(std::min<Int128>(1 << 23, std::max<Int128>(exact, -(1 << 30)))));
      } else {
        ASSERT_EQ(lo[n],
                  static_cast<std::int32_t>(std::max<Int128>(-(1 << 23), std::min<Int128>(exact, 1 << 30))));
      }
    }
  }
}

}  // namespace
}  // namespace footwall::voxelize::detail
