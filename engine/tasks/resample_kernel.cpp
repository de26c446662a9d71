#include "engine/tasks/resample_kernel.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

// Keys 1981, the kernel of fourth order: piecewise cubic over six points.
double keys(double x) {
  x = std::abs(x);
  if (x < 1) return (4.0 / 3 * x - 7.0 / 3) * x * x + 1;
  if (x < 2) return ((-7.0 / 12 * x + 3) * x - 59.0 / 12) * x + 2.5;
  if (x < 3) return ((1.0 / 12 * x - 2.0 / 3) * x + 1.75) * x - 1.5;
  return 0;
}

double hat(double x) {
  return std::max(0.0, 1 - std::abs(x));
}

// Adds to the weights a hat of twice the width times (a + b d), d the tap's distance, with the a and b that
// make the weights' sum 1 and their first moment 0: then constants and slopes come out exactly.
void correct(std::vector<double>& weights, const std::vector<double>& distances, double width) {
  double m0 = 0, m1 = 0, t0 = 0, t1 = 0, t2 = 0;
  for (std::size_t n = 0; n < weights.size(); ++n) {
    const double d = distances[n];
    const double t = hat(d / (2 * width));
    m0 += weights[n];
    m1 += weights[n] * d;
    t0 += t;
    t1 += t * d;
    t2 += t * d * d;
  }
  const double det = t0 * t2 - t1 * t1;
  if (weights.size() < 2 || !(det > 0)) {
    for (double& weight : weights) weight = 1.0 / static_cast<double>(weights.size());
    return;
  }
  const double a = ((1 - m0) * t2 + m1 * t1) / det;
  const double b = (-m1 * t0 - (1 - m0) * t1) / det;
  for (std::size_t n = 0; n < weights.size(); ++n) {
    weights[n] += hat(distances[n] / (2 * width)) * (a + b * distances[n]);
  }
}

float without_nulls(const Taps::View& taps, const float* from, std::int64_t stride) {
  if (std::isnan(from[taps.nearest * stride])) return std::numeric_limits<float>::quiet_NaN();
  double sum = 0;
  double weight = 0;
  for (std::int64_t t = 0; t < taps.count; ++t) {
    const float value = from[t * stride];
    if (std::isnan(value)) continue;
    sum += taps.hat[t] * static_cast<double>(value);
    weight += taps.hat[t];
  }
  return static_cast<float>(sum / weight);  // the nearest tap's is above 0
}

}  // namespace

Taps::Taps(const AxisPlace& place) {
  require(place.old_count >= 1 && place.new_count >= 1, "both grids have samples");
  const double width = std::max(1.0, std::abs(place.step));
  const auto last = static_cast<double>(place.old_count - 1);
  entries_.reserve(static_cast<std::size_t>(place.new_count));
  std::vector<double> weights, distances;
  for (std::int64_t n = 0; n < place.new_count; ++n) {
    double at = place.offset + static_cast<double>(n) * place.step;
    // Rounding must not make a neighbour of what is the same sample, nor leave the old grid's ends.
    if (std::abs(at - std::nearbyint(at)) < 1e-9 * (1 + last)) at = std::nearbyint(at);
    at = std::clamp(at, 0.0, last);
    const auto first = static_cast<std::int64_t>(std::max(0.0, std::ceil(at - 3 * width)));
    const auto end = static_cast<std::int64_t>(std::min(last, std::floor(at + 3 * width))) + 1;
    weights.clear();
    distances.clear();
    for (std::int64_t old = first; old < end; ++old) {
      distances.push_back(static_cast<double>(old) - at);
      const double weight = keys(distances.back() / width) / width;
      weights.push_back(std::abs(weight) < 1e-12 ? 0 : weight);  // rounding, where the kernel is zero
    }
    correct(weights, distances, width);
    const auto nearest = static_cast<std::int64_t>(std::ceil(at - 0.5));
    entries_.push_back({first, end - first, nearest - first, static_cast<std::int64_t>(weights_.size())});
    for (std::size_t t = 0; t < weights.size(); ++t) {
      weights_.push_back(weights[t]);
      hats_.push_back(hat(distances[t] / width));
    }
  }
}

Taps::View Taps::at(std::int64_t index) const {
  const Entry& entry = entries_[static_cast<std::size_t>(index)];
  return {entry.first, entry.count, entry.nearest, weights_.data() + entry.at, hats_.data() + entry.at};
}

std::int64_t Taps::first_of(std::int64_t lo, std::int64_t hi) const {
  return std::min(at(lo).first, at(hi - 1).first);
}

std::int64_t Taps::end_of(std::int64_t lo, std::int64_t hi) const {
  const View a = at(lo);
  const View b = at(hi - 1);
  return std::max(a.first + a.count, b.first + b.count);
}

float combined(const Taps::View& taps, const float* from, std::int64_t stride) {
  double sum = 0;
  for (std::int64_t t = 0; t < taps.count; ++t) {
    sum += taps.weights[t] * static_cast<double>(from[t * stride]);
  }
  if (!std::isnan(sum)) return static_cast<float>(sum);
  return without_nulls(taps, from, stride);
}

void combine(const Taps::View& taps, std::span<const float* const> rows, std::int64_t count, float* to) {
  constexpr std::int64_t kTile = 512;
  double sums[kTile];
  std::vector<float> column(static_cast<std::size_t>(taps.count));
  for (std::int64_t from = 0; from < count; from += kTile) {
    const std::int64_t size = std::min(kTile, count - from);
    std::fill_n(sums, size, 0.0);
    for (std::int64_t t = 0; t < taps.count; ++t) {
      const auto weight = taps.weights[t];
      const float* row = rows[static_cast<std::size_t>(t)] + from;
      for (std::int64_t n = 0; n < size; ++n) sums[n] += weight * static_cast<double>(row[n]);
    }
    for (std::int64_t n = 0; n < size; ++n) {
      if (std::isnan(sums[n])) {
        for (std::int64_t t = 0; t < taps.count; ++t) {
          column[static_cast<std::size_t>(t)] = rows[static_cast<std::size_t>(t)][from + n];
        }
        to[from + n] = without_nulls(taps, column.data(), 1);
      } else {
        to[from + n] = static_cast<float>(sums[n]);
      }
    }
  }
}

}  // namespace footwall::tasks
