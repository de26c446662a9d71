// The layers before they were folded and faulted: impedance as a function of stratigraphic depth.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/synthetic/detail/wavelet.h"

namespace footwall::synthetic::detail {

class Strata {
 public:
  // Layers for `samples` samples of depth; beyond 8192 samples the sequence repeats. Scaled so that its
  // response to the wavelet has rms 1 where `modulation`, the second argument of impedance(), has the mean
  // square given.
  Strata(std::uint64_t seed, std::int64_t samples, double modulation_mean_square, const Wavelet& wavelet);

  // The impedance at a depth in samples, any sign: linear between table entries, smoothed over one sample so
  // that a boundary that crosses the sampling grid does not jump. modulation in [-1,1] varies the layers
  // sideways.
  double impedance(double depth, double modulation) const {
    const double at = (depth + kPositive) * kPerSample;
    const auto below = static_cast<std::int64_t>(at);
    const double fraction = at - static_cast<double>(below);
    const Entry& a = table_[static_cast<std::size_t>(below) & mask_];
    const Entry& b = table_[static_cast<std::size_t>(below + 1) & mask_];
    const double base = a.base + (b.base - a.base) * fraction;
    const double varied = a.varied + (b.varied - a.varied) * fraction;
    return base + varied * modulation;
  }

 private:
  struct Entry {
    double base = 0;
    double varied = 0;
  };
  static constexpr std::int64_t kPerSample = 8;
  // A multiple of every table length, so that depths above the survey are positive when truncated.
  static constexpr double kPositive = 1 << 26;

  void deposit(std::uint64_t seed);
  void smooth();
  void normalise(std::int64_t samples, double modulation_mean_square, const Wavelet& wavelet);

  std::vector<Entry> table_;
  std::size_t mask_ = 0;
};

}  // namespace footwall::synthetic::detail
