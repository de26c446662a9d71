// Statistics of a stream of float32 samples in bounded memory, exact where it matters and free of order.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "storage/volume/volume_info.h"

namespace footwall::volume {

__extension__ typedef unsigned __int128 Wide128;

// One bin per pattern of a float's top 16 bits (sign, exponent, 7 bits of mantissa). A bin keeps how many
// samples fell in and the integer sums of their low 16 bits and of the squares of those: that is the exact
// sum and the exact spread of the bin, so mean and stddev come from exact integers, rounded once per bin, and
// percentiles are known to a bin's width, 2^-7 of the value. Merging accumulators in any order gives the same
// bits. NaN falls in bins of its own and counts as null; infinities must have been turned into NaN
// (copy_clean).
class SampleStatistics {
 public:
  // All that an accumulator knows, to be sent elsewhere. Those of two are combined by adding the numbers
  // place by place (they do not overflow in any sum over fewer than 2^31 accumulators), and by the smaller
  // min and the larger max.
  struct Totals {
    std::vector<std::uint64_t> numbers;
    float min = 0;
    float max = 0;
  };

  SampleStatistics();
  explicit SampleStatistics(const Totals& totals);
  Totals totals();
  void add(std::span<const float> values);
  void merge(SampleStatistics& other);
  // live_traces is taken over; the rest is computed.
  Statistics result(std::int64_t live_traces);

 private:
  struct Quick {                      // what the hot loop touches: one cache line a sample
    std::uint64_t count_and_sum = 0;  // count in the top 24 bits, sum of the low halves below
    std::uint64_t squares = 0;
  };
  struct Wide {
    std::uint64_t count = 0;
    std::uint64_t sum = 0;
    Wide128 squares = 0;
  };
  void flush();
  static void add_wide(Wide& into, const Wide& more);

  std::vector<Quick> quick_;
  std::vector<Wide> wide_;
  std::size_t pending_ = 0;  // samples in quick_
  float min_;
  float max_;
};

}  // namespace footwall::volume
