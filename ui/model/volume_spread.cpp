#include "ui/model/volume_spread.h"

#include <algorithm>
#include <cmath>

namespace footwall::ui {
namespace {

constexpr double kLeastClip = 75;  // percent

// 0 to 100; between the whole percentiles as sample_colours.cpp goes between them.
double percentile_of(const std::vector<double>& percentiles, double value) {
  const auto above = std::ranges::lower_bound(percentiles, value);
  if (above == percentiles.begin()) return 0;
  if (above == percentiles.end()) return 100;
  const double before = *std::prev(above);
  const double part = *above > before ? (value - before) / (*above - before) : 1;
  return static_cast<double>(above - percentiles.begin()) - 1 + part;
}

}  // namespace

std::vector<double> bar_heights(const volume::Histogram& histogram, int bars) {
  std::vector<double> heights(static_cast<std::size_t>(bars));
  for (int n = 0; n < volume::Histogram::kBins; ++n) {
    heights[static_cast<std::size_t>(n * bars / volume::Histogram::kBins)] +=
        static_cast<double>(histogram.counts[static_cast<std::size_t>(n)]);
  }
  const double most = *std::max_element(heights.begin(), heights.end());
  for (double& height : heights) height = most > 0 ? std::sqrt(height / most) : 0;
  return heights;
}

SampleLook clipped_at(SampleLook look, const SectionReader::VolumeFacts& facts, double value, bool is_low) {
  double clip = 0;
  if (facts.signed_values) {
    clip = percentile_of(facts.percentiles, is_low ? -value : value);
  } else {
    const double place = percentile_of(facts.percentiles, value);
    clip = is_low ? 100 - place : place;
  }
  look.clip_percentile = std::clamp(std::round(clip * 100) / 100, kLeastClip, 100.0);
  look.gain = 1;
  return look;
}

}  // namespace footwall::ui
