// Exact sums of float32 values and of their squares, with extremes: any order and grouping of the same values
// gives the same bits, so a face may be folded by many ranks, threads and instruction sets.
//
// Values v are multiples of 2^-149 and squares multiples of 2^-298; the sums are kept as integers in these
// units. How a block of values is folded fast: doubles hold their sum, and the sum of the high and of the low
// parts of their squares, without rounding as long as all of them lie within 20 binades of the largest; the
// few smaller ones are added one by one.
#pragma once
#include <cstdint>
#include <limits>
#include <span>

#include "engine/extract/statistics/wide_integer.h"

namespace footwall::extract {

struct Moments {
  std::int64_t count = 0;  // finite values; up to 2^40
  std::int64_t nulls = 0;  // NaN or infinite
  float min = std::numeric_limits<float>::infinity();
  float max = -std::numeric_limits<float>::infinity();
  WideInteger<5> sum;       // in units of 2^-149: 24 + 253 + 40 bits and a sign
  WideInteger<10> squares;  // in units of 2^-298: 48 + 506 + 40 bits

  void merge(const Moments& other);
  // The double nearest to the mean; NaN for count 0.
  double mean() const;
  // The double nearest to the sample variance; 0 for count 0 or 1.
  double variance() const;
};

inline constexpr std::size_t kBlockValues = 1024;
inline constexpr std::size_t kBlockPadding = 16;  // lanes of the widest vector

// Folds block[0, n) for n <= kBlockValues; block must have room for n + kBlockPadding values, all of which it
// overwrites.
void fold_block(float* block, std::size_t n, Moments& into);
// Any number of values; a copy is folded.
void fold(std::span<const float> values, Moments& into);

}  // namespace footwall::extract
