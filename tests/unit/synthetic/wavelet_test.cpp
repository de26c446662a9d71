#include "engine/synthetic/detail/wavelet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace footwall::synthetic::detail {
namespace {

TEST(Wavelet, IsARickerWithoutMean) {
  const Wavelet wavelet = ricker();
  double sum = wavelet[0];
  for (int t = 0; t <= kWaveletHalf; ++t) {
    const double a = std::pow(M_PI * kDominantFrequency * t, 2);
    EXPECT_NEAR(wavelet[t], (1 - 2 * a) * std::exp(-a), 1e-4) << t;
    if (t > 0) sum += 2 * wavelet[t];
  }
  EXPECT_NEAR(sum, 0, 1e-13);
}

// Lengths that are no multiple of the vector width, against the definition.
TEST(Wavelet, ConvolvesAsDefined) {
  const Wavelet wavelet = ricker();
  for (const int count : {1, 7, 8, 9, 31}) {
    std::vector<double> in(static_cast<std::size_t>(count + 2 * kWaveletHalf));
    for (std::size_t n = 0; n < in.size(); ++n) in[n] = static_cast<double>(n * n % 17) - 8;
    std::vector<double> out(static_cast<std::size_t>(count));
    convolve(wavelet, in.data(), count, out.data());
    for (int n = 0; n < count; ++n) {
      double sum = 0;
      for (int t = -kWaveletHalf; t <= kWaveletHalf; ++t) {
        sum += wavelet[std::abs(t)] * in[static_cast<std::size_t>(n + kWaveletHalf + t)];
      }
      EXPECT_NEAR(out[n], sum, 1e-12) << count << " " << n;
    }
  }
}

}  // namespace
}  // namespace footwall::synthetic::detail
