// The Ricker wavelet that signal and noise are both seen through.
#pragma once
#include <array>

namespace footwall::synthetic::detail {

inline constexpr double kDominantFrequency = 0.085;  // cycles per sample: 21 Hz at 4 ms
inline constexpr int kWaveletHalf = 14;              // where it has fallen below 1e-4 of its peak

// w[t] for lags 0 .. kWaveletHalf; the wavelet is symmetric, and its samples sum to zero.
using Wavelet = std::array<double, kWaveletHalf + 1>;
Wavelet ricker();

// out[n] = sum over t of w[|t|] in[n + kWaveletHalf + t], always summed in the same order.
void convolve(const Wavelet& wavelet, const double* in, int count, double* out);

}  // namespace footwall::synthetic::detail
