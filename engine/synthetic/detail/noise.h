// White noise that is a function of seed and voxel, mixed over neighbouring traces.
#pragma once
#include <array>
#include <cstdint>

#include "engine/synthetic/detail/wavelet.h"

namespace footwall::synthetic::detail {

struct Noise {
  std::uint64_t key = 0;
  double gain = 0;  // 0 = no noise

  // Scaled so that its response to the wavelet has rms 1 / signal_to_noise.
  Noise(std::uint64_t seed, double signal_to_noise, const Wavelet& wavelet);
};

// The noise of a run of samples on one inline, crossline after crossline: each voxel is the sum over 3x3
// traces with weights 1 2 1 both ways, all in integers.
class NoiseRun {
 public:
  static constexpr int kMost = 1024 + 2 * kWaveletHalf;

  // Stands at crossline j; first >= -kWaveletHalf, count <= kMost.
  NoiseRun(const Noise& noise, std::int64_t i, std::int64_t j, std::int64_t first, int count);
  void next_crossline();
  // Adds the noise, scaled, to `count` values.
  void add_to(double* values) const;

 private:
  // Room for the whole quads that a run begins and ends in.
  using Row = std::array<std::int32_t, kMost + 8>;
  // The three inlines i-1, i, i+1 mixed, at a crossline.
  void mix_inlines(std::int64_t j, Row& row) const;

  const Noise& noise_;
  std::int64_t i_;
  std::int64_t j_;
  std::int64_t quad_;  // four samples share a random number
  int quads_;
  int skip_;  // samples of the first quad that lie before the run
  int count_;
  std::array<Row, 3> rows_;  // of crossline j at j % 3
};

}  // namespace footwall::synthetic::detail
