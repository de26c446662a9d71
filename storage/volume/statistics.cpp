#include "storage/volume/statistics.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "storage/base/error.h"

namespace footwall::volume {
namespace {

constexpr int kBins = 1 << 16;
constexpr std::size_t kNumbersOfBin = 4;
constexpr int kFiniteMagnitudes = 0x7f80;  // bins of one sign below infinity
constexpr int kSumBits = 40;               // 2^24 low halves of 16 bits add up to less than 2^40
constexpr std::size_t kMostBetweenFlushes = (std::size_t{1} << 24) - 1;

// The value of magnitude bin h's lower edge, and of one unit of the low half within it.
double edge_of(int h) {
  const int exponent = h >> 7;
  const double mantissa = (h & 127) + (exponent == 0 ? 0 : 128);
  return std::ldexp(mantissa, (exponent == 0 ? 1 : exponent) - 150 + 16);
}
double unit_of(int h) {
  return std::ldexp(1.0, std::max(h >> 7, 1) - 150);
}

// Neumaier's sum: the error of each addition is carried along.
class CompensatedSum {
 public:
  void add(double x) {
    const double next = sum_ + x;
    carried_ += std::abs(sum_) >= std::abs(x) ? (sum_ - next) + x : (x - next) + sum_;
    sum_ = next;
  }
  double value() const { return sum_ + carried_; }

 private:
  double sum_ = 0;
  double carried_ = 0;
};

// A bin in order of value, with what its integers say.
struct Slice {
  double lo = 0;
  double hi = 0;
  double mean = 0;
  double spread = 0;  // sum of squared distances from the mean
  std::int64_t count = 0;
};

}  // namespace

SampleStatistics::SampleStatistics()
    : quick_(kBins),
      wide_(kBins),
      min_(std::numeric_limits<float>::infinity()),
      max_(-std::numeric_limits<float>::infinity()) {}

// A bin's numbers: count, sum, and the sum of squares in two halves, so that they add up without carries.
SampleStatistics::SampleStatistics(const Totals& totals) : SampleStatistics() {
  require(totals.numbers.size() == kNumbersOfBin * kBins, "the numbers of all bins");
  min_ = totals.min;
  max_ = totals.max;
  const std::uint64_t* from = totals.numbers.data();
  for (Wide& bin : wide_) {
    bin = {from[0], from[1], (static_cast<Wide128>(from[3]) << 32) + from[2]};
    from += kNumbersOfBin;
  }
}

SampleStatistics::Totals SampleStatistics::totals() {
  flush();
  Totals totals{{}, min_, max_};
  totals.numbers.reserve(kNumbersOfBin * kBins);
  for (const Wide& bin : wide_) {
    const auto low = static_cast<std::uint64_t>(bin.squares & 0xffffffffU);
    const auto high = static_cast<std::uint64_t>(bin.squares >> 32);
    totals.numbers.insert(totals.numbers.end(), {bin.count, bin.sum, low, high});
  }
  return totals;
}

void SampleStatistics::add(std::span<const float> values) {
  constexpr std::size_t kLanes = 16;
  float least[kLanes];
  float most[kLanes];
  std::fill_n(least, kLanes, min_);
  std::fill_n(most, kLanes, max_);
  while (!values.empty()) {
    if (pending_ == kMostBetweenFlushes) flush();
    const std::span<const float> piece =
        values.first(std::min(values.size(), kMostBetweenFlushes - pending_));
    values = values.subspan(piece.size());
    pending_ += piece.size();
    std::size_t n = 0;
    for (; n + kLanes <= piece.size(); n += kLanes) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const float v = piece[n + lane];  // both comparisons are false for NaN
        least[lane] = v < least[lane] ? v : least[lane];
        most[lane] = v > most[lane] ? v : most[lane];
      }
    }
    for (; n < piece.size(); ++n) {
      const float v = piece[n];
      least[0] = v < least[0] ? v : least[0];
      most[0] = v > most[0] ? v : most[0];
    }
    for (const float v : piece) {
      const auto bits = std::bit_cast<std::uint32_t>(v);
      const std::uint64_t low = bits & 0xffffU;
      Quick& bin = quick_[bits >> 16];
      bin.count_and_sum += (std::uint64_t{1} << kSumBits) | low;
      bin.squares += low * low;
    }
  }
  min_ = *std::min_element(least, least + kLanes);
  max_ = *std::max_element(most, most + kLanes);
}

void SampleStatistics::add_wide(Wide& into, const Wide& more) {
  into.count += more.count;
  into.sum += more.sum;
  into.squares += more.squares;
}

void SampleStatistics::flush() {
  for (std::size_t b = 0; b < kBins; ++b) {
    Quick& bin = quick_[b];
    if (bin.count_and_sum == 0) continue;
    add_wide(wide_[b], {bin.count_and_sum >> kSumBits,
                        bin.count_and_sum & ((std::uint64_t{1} << kSumBits) - 1), bin.squares});
    bin = {};
  }
  pending_ = 0;
}

void SampleStatistics::merge(SampleStatistics& other) {
  other.flush();
  for (std::size_t b = 0; b < kBins; ++b) add_wide(wide_[b], other.wide_[b]);
  min_ = std::min(min_, other.min_);
  max_ = std::max(max_, other.max_);
}

Statistics SampleStatistics::result(std::int64_t live_traces) {
  flush();
  Statistics s;
  s.live_traces = live_traces;
  s.percentiles.assign(101, 0);
  std::vector<Slice> slices;  // in rising order of value, empty ones left out
  const auto take = [&](int sign, int h) {
    const Wide& bin = wide_[static_cast<std::size_t>((sign < 0 ? 0x8000 : 0) | h)];
    if (bin.count == 0) return;
    const double n = static_cast<double>(bin.count);
    // n * squares - sum^2 is the spread about the mean times n, exactly: shifting by the high half changes
    // nothing.
    const Wide128 spread = bin.squares * bin.count - static_cast<Wide128>(bin.sum) * bin.sum;
    const double unit = unit_of(h);
    const double magnitude = edge_of(h) + static_cast<double>(bin.sum) / n * unit;
    const double from = sign * edge_of(h);
    const double to = sign * edge_of(h + 1);
    slices.push_back({std::min(from, to), std::max(from, to), sign * magnitude,
                      static_cast<double>(spread) / n * unit * unit, static_cast<std::int64_t>(bin.count)});
    s.count += static_cast<std::int64_t>(bin.count);
  };
  for (int h = kFiniteMagnitudes - 1; h >= 0; --h) take(-1, h);
  for (int h = 0; h < kFiniteMagnitudes; ++h) take(1, h);
  for (int h = kFiniteMagnitudes; h < 0x8000; ++h) {
    s.null_count += static_cast<std::int64_t>(wide_[static_cast<std::size_t>(h)].count +
                                              wide_[static_cast<std::size_t>(h | 0x8000)].count);
  }
  if (s.count == 0) return s;

  // -0 and +0 compare equal; adding +0 makes it +0 whichever was met first.
  s.min = static_cast<double>(min_ + 0.0F);
  s.max = static_cast<double>(max_ + 0.0F);
  s.max_abs = std::max(std::abs(s.min), std::abs(s.max));
  CompensatedSum sum;
  for (const Slice& slice : slices) sum.add(slice.mean * static_cast<double>(slice.count));
  s.mean = sum.value() / static_cast<double>(s.count);
  CompensatedSum spread;  // every term is positive: nothing cancels
  for (const Slice& slice : slices) {
    const double off = slice.mean - s.mean;
    spread.add(slice.spread);
    spread.add(off * off * static_cast<double>(slice.count));
  }
  s.stddev = std::sqrt(spread.value() / static_cast<double>(s.count));

  std::int64_t before = 0;
  std::size_t at = 0;
  for (std::int64_t p = 0; p <= 100; ++p) {
    const std::int64_t rank = std::max<std::int64_t>(1, (p * s.count + 99) / 100);
    while (before + slices[at].count < rank) before += slices[at++].count;
    const Slice& slice = slices[at];
    const double within = (static_cast<double>(rank - before) - 0.5) / static_cast<double>(slice.count);
    const double spread_out = slice.lo + (slice.hi - slice.lo) * within;
    s.percentiles[static_cast<std::size_t>(p)] =
        std::clamp(slice.spread == 0 ? slice.mean : spread_out, s.min, s.max);
  }
  s.percentiles.front() = s.min;
  s.percentiles.back() = s.max;
  // A bin of equal values says its mean exactly, its neighbour only roughly: keep them in order.
  for (std::size_t p = 1; p <= 100; ++p) s.percentiles[p] = std::max(s.percentiles[p], s.percentiles[p - 1]);

  s.histogram.lo = s.min;
  s.histogram.hi = s.max;
  const double width = (s.max - s.min) / Histogram::kBins;
  const auto bin_of = [&](double v) {
    return width > 0 ? std::clamp(static_cast<int>((v - s.min) / width), 0, Histogram::kBins - 1)
                     : Histogram::kBins - 1;
  };
  for (const Slice& slice : slices) {
    const double lo = std::max(slice.lo, s.min);
    const double hi = std::min(slice.hi, s.max);
    if (slice.spread == 0 || hi <= lo) {
      s.histogram.counts[static_cast<std::size_t>(bin_of(slice.mean))] += slice.count;
      continue;
    }
    std::int64_t given = 0;
    const int last = bin_of(hi);
    for (int bin = bin_of(lo); bin <= last; ++bin) {
      const double share = std::clamp((s.min + width * (bin + 1) - lo) / (hi - lo), 0.0, 1.0);
      const std::int64_t upto =
          bin == last ? slice.count
                      : std::clamp(static_cast<std::int64_t>(share * static_cast<double>(slice.count)), given,
                                   slice.count);
      s.histogram.counts[static_cast<std::size_t>(bin)] += upto - given;
      given = upto;
    }
  }
  return s;
}

}  // namespace footwall::volume
