#include "engine/synthetic/detail/noise.h"

#include <cmath>

#include "engine/synthetic/detail/random.h"

namespace footwall::synthetic::detail {
namespace {

constexpr std::uint64_t kNoisePurpose = 16;

// The slot of crossline j, which may be -1.
std::size_t slot(std::int64_t j) {
  return static_cast<std::size_t>((j + 3) % 3);
}

// An odd number in [-65535, 65535], all equally likely, from the lowest 16 bits.
std::int32_t centred(std::uint64_t bits) {
  return 2 * static_cast<std::int32_t>(bits & 0xffff) - 65535;
}

}  // namespace

Noise::Noise(std::uint64_t seed, double signal_to_noise, const Wavelet& wavelet)
    : key(mixed(mixed(seed + kGolden) + kNoisePurpose * kGolden)) {
  if (!std::isfinite(signal_to_noise)) return;
  constexpr double kUniformVariance = (65536.0 * 65536.0 - 1) / 3;
  constexpr double kMixing = (1 + 4 + 1) * (1 + 4 + 1);
  double power = wavelet[0] * wavelet[0];
  for (int t = 1; t <= kWaveletHalf; ++t) power += 2 * wavelet[t] * wavelet[t];
  gain = 1 / (signal_to_noise * std::sqrt(kUniformVariance * kMixing * power));
}

NoiseRun::NoiseRun(const Noise& noise, std::int64_t i, std::int64_t j, std::int64_t first, int count)
    : noise_(noise), i_(i), j_(j), count_(count) {
  constexpr std::int64_t kAbove = 16;  // makes every sample number positive; whole quads
  quad_ = (first + kAbove) / 4;
  skip_ = static_cast<int>((first + kAbove) % 4);
  quads_ = (skip_ + count + 3) / 4;
  if (noise_.gain == 0) return;
  for (std::int64_t beside = j - 1; beside <= j + 1; ++beside) mix_inlines(beside, rows_[slot(beside)]);
}

void NoiseRun::next_crossline() {
  ++j_;
  if (noise_.gain != 0) mix_inlines(j_ + 1, rows_[slot(j_ + 1)]);
}

void NoiseRun::mix_inlines(std::int64_t j, Row& row) const {
  std::array<std::uint64_t, 3> keys{};
  for (int beside = 0; beside < 3; ++beside) {
    const auto trace = static_cast<std::uint64_t>(i_ + beside) << 32 | static_cast<std::uint64_t>(j + 1);
    keys[beside] = mixed(noise_.key ^ mixed(trace));
  }
  for (int q = 0; q < quads_; ++q) {
    const std::uint64_t counter = static_cast<std::uint64_t>(quad_ + q) * kGolden;
    const std::uint64_t before = mixed(keys[0] + counter);
    const std::uint64_t here = mixed(keys[1] + counter);
    const std::uint64_t after = mixed(keys[2] + counter);
    for (int n = 0; n < 4; ++n) {
      row[4 * q + n] =
          centred(before >> (16 * n)) + 2 * centred(here >> (16 * n)) + centred(after >> (16 * n));
    }
  }
}

void NoiseRun::add_to(double* values) const {
  if (noise_.gain == 0) return;
  const std::int32_t* before = rows_[slot(j_ - 1)].data() + skip_;
  const std::int32_t* here = rows_[slot(j_)].data() + skip_;
  const std::int32_t* after = rows_[slot(j_ + 1)].data() + skip_;
  for (int n = 0; n < count_; ++n) values[n] += noise_.gain * (before[n] + 2 * here[n] + after[n]);
}

}  // namespace footwall::synthetic::detail
