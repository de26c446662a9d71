#include "storage/volume/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace footwall::volume {
namespace {

Statistics of(const std::vector<float>& values) {
  SampleStatistics statistics;
  statistics.add(values);
  return statistics.result(0);
}

std::vector<float> noise(std::size_t count, float centre, float width) {
  std::mt19937_64 random(3);
  std::vector<float> values(count);
  for (float& v : values) {
    double sum = 0;
    for (int n = 0; n < 4; ++n) sum += static_cast<double>(random() >> 11) / 9007199254740992.0 - 0.5;
    v = centre + width * static_cast<float>(sum);
  }
  return values;
}

TEST(SampleStatistics, AgreesWithLongDoublesOnOrdinaryAndOffsetData) {
  for (const auto& [centre, width] : {std::pair{0.0F, 1000.0F}, std::pair{3000.0F, 0.5F},
                                      std::pair{-1e-3F, 1e-9F}, std::pair{1e30F, 1e29F}}) {
    const std::vector<float> values = noise(100003, centre, width);
    long double sum = 0;
    for (const float v : values) sum += v;
    const long double mean = sum / static_cast<long double>(values.size());
    long double spread = 0;
    for (const float v : values) spread += (v - mean) * (v - mean);
    const Statistics s = of(values);
    const auto stddev = static_cast<double>(std::sqrt(spread / static_cast<long double>(values.size())));
    EXPECT_NEAR(s.mean, static_cast<double>(mean),
                1e-15 * std::abs(static_cast<double>(mean)) + 1e-16 * width);
    EXPECT_NEAR(s.stddev, stddev, 1e-13 * stddev);
    EXPECT_EQ(s.min, *std::min_element(values.begin(), values.end()));
    EXPECT_EQ(s.max, *std::max_element(values.begin(), values.end()));
  }
}

TEST(SampleStatistics, TotalsOfPartsAddUpToThoseOfTheWhole) {
  std::vector<float> values = noise(40000, -5, 1e6F);
  values[7] = std::numeric_limits<float>::quiet_NaN();
  // Squares of a bin that fill the lower half of their sum many times over.
  values.insert(values.end(), 300000, std::nextafter(2.0F, 1.0F));
  SampleStatistics first;
  SampleStatistics second;
  first.add(std::span(values).first(150000));
  second.add(std::span(values).subspan(150000));
  SampleStatistics::Totals sum = first.totals();
  const SampleStatistics::Totals more = second.totals();
  ASSERT_EQ(sum.numbers.size(), more.numbers.size());
  for (std::size_t n = 0; n < sum.numbers.size(); ++n) sum.numbers[n] += more.numbers[n];
  sum.min = std::min(sum.min, more.min);
  sum.max = std::max(sum.max, more.max);
  EXPECT_EQ(SampleStatistics(sum).result(0), of(values));
}

TEST(SampleStatistics, PercentilesAreGoodTo2ToTheMinus7) {
  std::vector<float> values = noise(50001, 0, 100);
  const Statistics s = of(values);
  std::sort(values.begin(), values.end());
  for (std::size_t p = 0; p <= 100; ++p) {
    const std::size_t rank = std::max<std::size_t>(1, (p * values.size() + 99) / 100);
    const double exact = values[rank - 1];
    EXPECT_NEAR(s.percentiles[p], exact, std::abs(exact) / 128 + 1e-30) << p;
  }
  EXPECT_TRUE(std::is_sorted(s.percentiles.begin(), s.percentiles.end()));
  EXPECT_EQ(s.percentiles[0], s.min);
  EXPECT_EQ(s.percentiles[100], s.max);
}

TEST(SampleStatistics, TheHistogramCountsEverySample) {
  const std::vector<float> values = noise(50001, 0, 100);
  const Statistics s = of(values);
  EXPECT_EQ(std::accumulate(s.histogram.counts.begin(), s.histogram.counts.end(), std::int64_t{0}), 50001);
  std::vector<std::int64_t> exact(Histogram::kBins, 0);
  const double width = (s.max - s.min) / Histogram::kBins;
  for (const float v : values) {
    ++exact[static_cast<std::size_t>(std::min(255.0, (static_cast<double>(v) - s.min) / width))];
  }
  std::int64_t running = 0;
  std::int64_t running_exact = 0;
  for (std::size_t bin = 0; bin < exact.size(); ++bin) {
    running += s.histogram.counts[bin];
    running_exact += exact[bin];
    EXPECT_NEAR(static_cast<double>(running), static_cast<double>(running_exact), 50001 * 0.006) << bin;
  }
}

TEST(SampleStatistics, OrderAndSplittingChangeNothing) {
  std::vector<float> values = noise(20000, 5, 3000);
  values.push_back(std::numeric_limits<float>::quiet_NaN());
  values.push_back(-std::numeric_limits<float>::quiet_NaN());
  const Statistics straight = of(values);
  EXPECT_EQ(straight.null_count, 2);
  std::shuffle(values.begin(), values.end(), std::mt19937(5));
  SampleStatistics a;
  SampleStatistics b;
  for (std::size_t n = 0; n < values.size(); ++n) (n % 3 == 0 ? a : b).add(std::span(&values[n], 1));
  b.merge(a);
  EXPECT_EQ(b.result(0), straight);
}

TEST(SampleStatistics, ConstantZeroSubnormalAndExtremeValues) {
  const Statistics constant = of(std::vector<float>(1000, 0.1F));
  EXPECT_EQ(constant.mean, static_cast<double>(0.1F));
  EXPECT_EQ(constant.stddev, 0);
  EXPECT_EQ(constant.percentiles[50], static_cast<double>(0.1F));
  EXPECT_EQ(constant.histogram.counts[255], 1000);
  const float tiny = std::numeric_limits<float>::denorm_min();
  const Statistics small = of({tiny, 3 * tiny, 0.0F, -0.0F});
  EXPECT_EQ(small.mean, static_cast<double>(tiny));
  EXPECT_EQ(small.count, 4);
  const float huge = std::numeric_limits<float>::max();
  const Statistics large = of({huge, -huge, huge, -huge});
  EXPECT_EQ(large.mean, 0);
  EXPECT_EQ(large.stddev, static_cast<double>(huge));
  EXPECT_EQ(large.max_abs, static_cast<double>(huge));
}

TEST(SampleStatistics, CountsBeyondOneFlush) {
  SampleStatistics statistics;
  const std::vector<float> block(1 << 20, 65535.996F);  // the low half is all ones: the largest sums
  for (int n = 0; n < 40; ++n) statistics.add(block);
  const Statistics s = statistics.result(0);
  EXPECT_EQ(s.count, std::int64_t{40} << 20);
  EXPECT_EQ(s.mean, static_cast<double>(65535.996F));
  EXPECT_EQ(s.stddev, 0);
}

}  // namespace
}  // namespace footwall::volume
