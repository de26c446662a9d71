#include "engine/verify/resample_by_definition.h"

#include <cmath>
#include <vector>

namespace footwall::verify {
namespace {

// The fourth-order kernel of Keys 1981 as it is printed.
double kernel(double s) {
  const double a = std::abs(s);
  if (a < 1) return 4.0 / 3.0 * a * a * a - 7.0 / 3.0 * a * a + 1;
  if (a < 2) return -7.0 / 12.0 * a * a * a + 3 * a * a - 59.0 / 12.0 * a + 15.0 / 6.0;
  if (a < 3) return 1.0 / 12.0 * a * a * a - 2.0 / 3.0 * a * a + 21.0 / 12.0 * a - 3.0 / 2.0;
  return 0;
}

// Weights over the whole axis: the stretched kernel plus p(d) hat(d / 2w), p the polynomial of degree one
// that makes them reproduce 1 and x.
std::vector<double> weights(std::int64_t count, double at, double spacing) {
  if (count == 1) return {1};
  const double w = std::max(1.0, spacing);
  double k0 = 0, k1 = 0, h0 = 0, h1 = 0, h2 = 0;
  std::vector<double> all(static_cast<std::size_t>(count));
  const auto is_tap = [&](double d) { return std::abs(d) <= 3 * w; };
  const auto hat = [&](double d) { return std::max(0.0, 1 - std::abs(d) / (2 * w)); };
  for (std::int64_t n = 0; n < count; ++n) {
    const double d = static_cast<double>(n) - at;
    if (!is_tap(d)) continue;
    k0 += kernel(d / w) / w;
    k1 += kernel(d / w) / w * d;
    h0 += hat(d);
    h1 += hat(d) * d;
    h2 += hat(d) * d * d;
  }
  // p0 h0 + p1 h1 = 1 - k0 and p0 h1 + p1 h2 = -k1, by Cramer's rule.
  const double det = h0 * h2 - h1 * h1;
  const double p0 = ((1 - k0) * h2 - h1 * -k1) / det;
  const double p1 = (h0 * -k1 - h1 * (1 - k0)) / det;
  for (std::int64_t n = 0; n < count; ++n) {
    const double d = static_cast<double>(n) - at;
    if (is_tap(d)) all[static_cast<std::size_t>(n)] = kernel(d / w) / w + hat(d) * (p0 + p1 * d);
  }
  return all;
}

}  // namespace

double resampled_sample(const std::function<double(std::int64_t, std::int64_t, std::int64_t)>& old,
                        const survey::Index& counts, const std::array<double, 3>& at,
                        const std::array<double, 3>& spacing) {
  const std::vector<double> wi = weights(counts[0], at[0], spacing[0]);
  const std::vector<double> wj = weights(counts[1], at[1], spacing[1]);
  const std::vector<double> wk = weights(counts[2], at[2], spacing[2]);
  double sum = 0;
  for (std::int64_t i = 0; i < counts[0]; ++i) {
    for (std::int64_t j = 0; j < counts[1]; ++j) {
      for (std::int64_t k = 0; k < counts[2]; ++k) {
        const double weight = wi[static_cast<std::size_t>(i)] * wj[static_cast<std::size_t>(j)] *
                              wk[static_cast<std::size_t>(k)];
        if (weight != 0) sum += weight * old(i, j, k);
      }
    }
  }
  return sum;
}

}  // namespace footwall::verify
