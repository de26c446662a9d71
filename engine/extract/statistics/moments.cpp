#include "engine/extract/statistics/moments.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "storage/base/error.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/extract/statistics/moments.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace footwall::extract::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Puts 0 in the place of what is not finite, and counts what is; range = {least, greatest, largest |v|,
// smallest |v| that is not 0 (infinity where there is none)}. n is a multiple of the lanes.
std::size_t scan(float* block, std::size_t n, float* range) {
  const hn::ScalableTag<float> d;
  const auto infinity = hn::Set(d, std::numeric_limits<float>::infinity());
  const auto greatest = hn::Set(d, std::numeric_limits<float>::max());
  auto low = infinity;
  auto high = hn::Neg(infinity);
  auto largest = hn::Zero(d);
  auto smallest = infinity;
  std::size_t finite = 0;
  for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
    const auto v = hn::Load(d, block + i);
    const auto a = hn::Abs(v);
    const auto good = hn::Le(a, greatest);
    const auto cleaned = hn::IfThenElseZero(good, v);
    finite += hn::CountTrue(d, good);
    low = hn::Min(low, hn::IfThenElse(good, v, infinity));
    high = hn::Max(high, hn::IfThenElse(good, v, hn::Neg(infinity)));
    const auto size = hn::Abs(cleaned);
    largest = hn::Max(largest, size);
    smallest = hn::Min(smallest, hn::IfThenElse(hn::Gt(size, hn::Zero(d)), size, infinity));
    hn::Store(cleaned, d, block + i);
  }
  range[0] = hn::GetLane(hn::MinOfLanes(d, low));
  range[1] = hn::GetLane(hn::MaxOfLanes(d, high));
  range[2] = hn::GetLane(hn::MaxOfLanes(d, largest));
  range[3] = hn::GetLane(hn::MinOfLanes(d, smallest));
  return finite;
}

// sums[0] = sum of v; sums[1] + sums[2] = sum of v * v. split is the constant that cuts off a square's low
// part.
void add_up(const float* block, std::size_t n, double split, double* sums) {
  const hn::ScalableTag<double> d;
  const hn::Rebind<float, decltype(d)> narrow;
  const auto splitter = hn::Set(d, split);
  auto sum = hn::Zero(d);
  auto high = hn::Zero(d);
  auto low = hn::Zero(d);
  for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
    const auto v = hn::PromoteTo(d, hn::Load(narrow, block + i));
    const auto square = hn::Mul(v, v);
    const auto top = hn::Sub(hn::Add(square, splitter), splitter);
    sum = hn::Add(sum, v);
    high = hn::Add(high, top);
    low = hn::Add(low, hn::Sub(square, top));
  }
  sums[0] = hn::GetLane(hn::SumOfLanes(d, sum));
  sums[1] = hn::GetLane(hn::SumOfLanes(d, high));
  sums[2] = hn::GetLane(hn::SumOfLanes(d, low));
}

}  // namespace footwall::extract::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace footwall::extract {

HWY_EXPORT(scan);
HWY_EXPORT(add_up);

namespace {

// One value as an integer times a power of two.
void add_one(float value, Moments& into) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
  const int biased = static_cast<int>((bits >> 23) & 0xff);
  std::int64_t mantissa = bits & 0x7fffff;
  if (biased != 0) mantissa |= 0x800000;
  const int shift = std::max(biased, 1) - 1;
  into.squares.add(mantissa * mantissa, 2 * shift);
  into.sum.add((bits >> 31) != 0 ? -mantissa : mantissa, shift);
}

// With at most 2^10 values below 2^k, of 24 bits and within 20 binades: their sum is a multiple of 2^(k-43)
// and at most 2^(k+10); the squares' high parts are multiples of 2^(2k-42) with a sum of at most 2^(2k+10),
// the low parts multiples of 2^(2k-86) with a sum of at most 2^(2k-33). All three fit in the 53 bits of a
// double.
constexpr int kSumUnit = -43;
constexpr int kHighUnit = -42;
constexpr int kLowUnit = 2 * kSumUnit;
constexpr int kSmallest = kSumUnit + 23;  // 2^(k-20) still has its last bit at the unit
static_assert(kBlockValues <= 1 << 10);
constexpr int kFloatUnit = -149;

// total is a multiple of 2^unit and fits.
template <std::size_t Words>
void add_double(double total, int unit, int base, WideInteger<Words>& into) {
  if (total != 0) into.add(static_cast<std::int64_t>(std::ldexp(total, -unit)), unit - base);
}

}  // namespace

void fold_block(float* block, std::size_t n, Moments& into) {
  require(n <= kBlockValues, "a block of values");
  if (n == 0) return;
  const std::size_t padded = (n + kBlockPadding - 1) / kBlockPadding * kBlockPadding;
  std::fill(block + n, block + padded, std::numeric_limits<float>::quiet_NaN());
  float range[4];
  const std::size_t finite = HWY_DYNAMIC_DISPATCH(scan)(block, padded, range);
  into.count += static_cast<std::int64_t>(finite);
  into.nulls += static_cast<std::int64_t>(n - finite);
  if (finite == 0) return;
  // Adding +0 turns -0 into 0: which of the two zeros comes first must not show.
  into.min = std::min(into.min, range[0] + 0.0F);
  into.max = std::max(into.max, range[1] + 0.0F);
  if (range[2] == 0) return;

  int k = 0;
  std::frexp(range[2], &k);  // every |v| < 2^k
  const float smallest = std::ldexp(1.0F, k + kSmallest);
  if (range[3] < smallest) {
    for (std::size_t i = 0; i < n; ++i) {
      if (block[i] != 0 && std::abs(block[i]) < smallest) {
        add_one(block[i], into);
        block[i] = 0;
      }
    }
  }
  double sums[3];
  const double split = std::ldexp(1.5, 52 + 2 * k + kHighUnit);
  HWY_DYNAMIC_DISPATCH(add_up)(block, padded, split, sums);
  add_double(sums[0], k + kSumUnit, kFloatUnit, into.sum);
  add_double(sums[1], 2 * k + kHighUnit, 2 * kFloatUnit, into.squares);
  add_double(sums[2], 2 * k + kLowUnit, 2 * kFloatUnit, into.squares);
}

void fold(std::span<const float> values, Moments& into) {
  alignas(64) float block[kBlockValues + kBlockPadding];
  while (!values.empty()) {
    const std::size_t n = std::min(values.size(), kBlockValues);
    std::copy_n(values.begin(), n, block);
    fold_block(block, n, into);
    values = values.subspan(n);
  }
}

void Moments::merge(const Moments& other) {
  count += other.count;
  nulls += other.nulls;
  min = std::min(min, other.min);
  max = std::max(max, other.max);
  sum.add(other.sum);
  squares.add(other.squares);
}

double Moments::mean() const {
  if (count == 0) return std::numeric_limits<double>::quiet_NaN();
  return nearest_quotient(sum.magnitude(), sum.negative(), kFloatUnit, static_cast<std::uint64_t>(count));
}

double Moments::variance() const {
  if (count <= 1) return 0;
  // n S2 - S1^2 in words: both are below 2^640, and the difference is not negative.
  const auto n = static_cast<std::uint64_t>(count);
  std::array<std::uint64_t, 11> difference{};
  UInt128 carry = 0;
  for (std::size_t word = 0; word < 10; ++word) {
    carry = (carry >> 64) + static_cast<UInt128>(squares.words()[word]) * n;
    difference[word] = static_cast<std::uint64_t>(carry);
  }
  difference[10] = static_cast<std::uint64_t>(carry >> 64);

  const auto s = sum.magnitude();
  std::array<std::uint64_t, 11> square{};
  for (std::size_t a = 0; a < s.size(); ++a) {
    if (s[a] == 0) continue;
    carry = 0;
    for (std::size_t b = 0; b < s.size(); ++b) {
      carry = (carry >> 64) + static_cast<UInt128>(s[a]) * s[b] + square[a + b];
      square[a + b] = static_cast<std::uint64_t>(carry);
    }
    square[a + s.size()] = static_cast<std::uint64_t>(carry >> 64);
  }
  std::uint64_t borrow = 0;
  for (std::size_t word = 0; word < difference.size(); ++word) {
    const UInt128 left = difference[word];
    const UInt128 right = static_cast<UInt128>(square[word]) + borrow;
    borrow = left < right ? 1 : 0;
    difference[word] = static_cast<std::uint64_t>(left - right);
  }
  return nearest_quotient(difference, false, 2 * kFloatUnit, n, n - 1);
}

}  // namespace footwall::extract
#endif
