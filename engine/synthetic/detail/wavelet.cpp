#include "engine/synthetic/detail/wavelet.h"

#include "engine/synthetic/detail/arithmetic.h"

namespace footwall::synthetic::detail {

Wavelet ricker() {
  constexpr double kPi = 3.141592653589793;
  Wavelet wavelet{};
  double sum = 0;
  for (int t = 0; t <= kWaveletHalf; ++t) {
    const double a = kPi * kPi * kDominantFrequency * kDominantFrequency * t * t;
    wavelet[t] = (1 - 2 * a) * exp_of_minus(a);
    sum += t == 0 ? wavelet[t] : 2 * wavelet[t];
  }
  // Cutting it off leaves a trace of a mean, which would show as drift where impedance trends.
  for (double& value : wavelet) value -= sum / (2 * kWaveletHalf + 1);
  return wavelet;
}

void convolve(const Wavelet& wavelet, const double* in, int count, double* out) {
  constexpr int kLanes = 8;  // independent sums, so that the compiler keeps them in vector registers
  const double* centre = in + kWaveletHalf;
  int n = 0;
  for (; n + kLanes <= count; n += kLanes) {
    double sum[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) sum[lane] = wavelet[0] * centre[n + lane];
    for (int t = 1; t <= kWaveletHalf; ++t) {
      for (int lane = 0; lane < kLanes; ++lane) {
        sum[lane] += wavelet[t] * (centre[n + lane - t] + centre[n + lane + t]);
      }
    }
    for (int lane = 0; lane < kLanes; ++lane) out[n + lane] = sum[lane];
  }
  for (; n < count; ++n) {
    double sum = wavelet[0] * centre[n];
    for (int t = 1; t <= kWaveletHalf; ++t) sum += wavelet[t] * (centre[n - t] + centre[n + t]);
    out[n] = sum;
  }
}

}  // namespace footwall::synthetic::detail
