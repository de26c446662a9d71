#include "engine/synthetic/detail/strata.h"

#include <algorithm>
#include <cmath>

#include "engine/synthetic/detail/random.h"

namespace footwall::synthetic::detail {
namespace {

constexpr std::int64_t kLeastSamples = 256;
constexpr std::int64_t kMostSamples = 8192;
constexpr std::uint64_t kPurpose = 1;

}  // namespace

Strata::Strata(std::uint64_t seed, std::int64_t samples, double modulation_mean_square,
               const Wavelet& wavelet) {
  std::int64_t length = kLeastSamples;
  while (length < kMostSamples && length < samples + samples / 2) length *= 2;
  table_.resize(static_cast<std::size_t>(length * kPerSample));
  mask_ = table_.size() - 1;
  deposit(seed);
  smooth();
  normalise(samples, modulation_mean_square, wavelet);
}

void Strata::deposit(std::uint64_t seed) {
  Draws draws(seed, kPurpose);
  double bottom = 0;
  Entry layer;
  for (std::size_t n = 0; n < table_.size(); ++n) {
    const double depth = static_cast<double>(n) / kPerSample;
    while (depth >= bottom) {
      // Mostly beds near tuning thickness, now and then a thick one that looks bland.
      const bool thick = draws.between(0, 1) < 0.08;
      bottom += thick ? draws.between(12, 24) : draws.between(2.5, 9);
      layer.base = draws.between(-1, 1);
      layer.varied = draws.between(-0.35, 0.35);
    }
    table_[n] = layer;
  }
}

// A triangle of half width one sample, around the table's end too.
void Strata::smooth() {
  const std::vector<Entry> sharp = table_;
  for (std::size_t n = 0; n < table_.size(); ++n) {
    Entry sum;
    for (std::int64_t lag = 1 - kPerSample; lag < kPerSample; ++lag) {
      const double weight =
          static_cast<double>(kPerSample - (lag < 0 ? -lag : lag)) / (kPerSample * kPerSample);
      const Entry& entry = sharp[(n + static_cast<std::size_t>(lag)) & mask_];
      sum.base += weight * entry.base;
      sum.varied += weight * entry.varied;
    }
    table_[n] = sum;
  }
}

void Strata::normalise(std::int64_t samples, double modulation_mean_square, const Wavelet& wavelet) {
  // A short survey sees too few layers to judge by; the whole table then.
  const auto all = static_cast<std::int64_t>(table_.size()) / kPerSample;
  const auto count = static_cast<int>(samples < 64 ? all : std::min(samples, all));
  std::vector<double> response(static_cast<std::size_t>(count));
  const auto mean_square = [&](double modulation, double without) {
    std::vector<double> reflectivity(static_cast<std::size_t>(count + 2 * kWaveletHalf));
    for (std::size_t n = 0; n < reflectivity.size(); ++n) {
      const double depth = static_cast<double>(n) - kWaveletHalf;
      reflectivity[n] = impedance(depth + 0.5, modulation) - impedance(depth - 0.5, modulation) -
                        without * (impedance(depth + 0.5, 0) - impedance(depth - 0.5, 0));
    }
    convolve(wavelet, reflectivity.data(), count, response.data());
    double sum = 0;
    for (const double value : response) sum += value * value;
    return sum / count;
  };
  const double power = mean_square(0, 0) + modulation_mean_square * mean_square(1, 1);
  const double scale = 1 / std::sqrt(power);
  for (Entry& entry : table_) {
    entry.base *= scale;
    entry.varied *= scale;
  }
}

}  // namespace footwall::synthetic::detail
