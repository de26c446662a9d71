#include "engine/extract/statistics/wide_integer.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "storage/base/error.h"

namespace footwall::extract {
namespace {

constexpr std::size_t kLongest = 24;
// Zero words below the magnitude: 192 bits leave a quotient of more than 64 bits after two 64-bit divisors.
constexpr std::size_t kBelow = 3;

// Divides in place, highest word first; returns whether something remains.
bool divide(std::span<std::uint64_t> words, std::uint64_t divisor) {
  UInt128 remainder = 0;
  for (std::size_t n = words.size(); n-- > 0;) {
    const UInt128 dividend = (remainder << 64) | words[n];
    words[n] = static_cast<std::uint64_t>(dividend / divisor);
    remainder = dividend % divisor;
  }
  return remainder != 0;
}

}  // namespace

double nearest_quotient(std::span<const std::uint64_t> magnitude, bool negative, int exponent,
                        std::uint64_t divisor, std::uint64_t second_divisor) {
  require(magnitude.size() <= kLongest && divisor != 0 && second_divisor != 0, "a quotient that fits");
  std::size_t used = magnitude.size();
  while (used > 0 && magnitude[used - 1] == 0) --used;
  if (used == 0) return 0;

  std::uint64_t buffer[kLongest + kBelow] = {};
  std::copy_n(magnitude.begin(), used, buffer + kBelow);
  std::span<std::uint64_t> quotient(buffer, used + kBelow);
  bool inexact = divide(quotient, divisor);
  if (second_divisor != 1) inexact = divide(quotient, second_divisor) || inexact;

  std::size_t top = quotient.size() - 1;
  while (quotient[top] == 0) --top;
  // The highest 64 bits, and whether anything follows them.
  const int lead = std::countl_zero(quotient[top]);
  std::uint64_t bits = quotient[top] << lead;
  if (lead != 0) {
    bits |= quotient[top - 1] >> (64 - lead);
    inexact = inexact || (quotient[top - 1] << lead) != 0;
  } else {
    inexact = inexact || quotient[top - 1] != 0;
  }
  for (std::size_t n = 0; n + 1 < top; ++n) inexact = inexact || quotient[n] != 0;

  constexpr int kDropped = 64 - 53;
  std::uint64_t mantissa = bits >> kDropped;
  const std::uint64_t rest = bits & ((std::uint64_t{1} << kDropped) - 1);
  constexpr std::uint64_t kHalf = std::uint64_t{1} << (kDropped - 1);
  if (rest > kHalf || (rest == kHalf && (inexact || (mantissa & 1) != 0))) ++mantissa;
  const int scale = exponent + (static_cast<int>(top) - static_cast<int>(kBelow)) * 64 - lead + kDropped;
  const double value = std::ldexp(static_cast<double>(mantissa), scale);
  return negative ? -value : value;
}

}  // namespace footwall::extract
