#include "engine/verify/statistics_by_definition.h"

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

namespace footwall::verify {
namespace {

using Integer = boost::multiprecision::cpp_int;
using Rational = boost::multiprecision::cpp_rational;

Rational power_of_two(int exponent) {
  const Integer power = Integer(1) << std::abs(exponent);
  return exponent >= 0 ? Rational(power) : Rational(Integer(1), power);
}

Rational exactly(double value) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  return Rational(Integer(static_cast<std::int64_t>(std::ldexp(mantissa, 53)))) * power_of_two(exponent - 53);
}

// Ties to even; for values that are normal doubles.
double nearest(const Rational& value) {
  if (value == 0) return 0;
  const Rational size = abs(value);
  int exponent = static_cast<int>(msb(numerator(size))) - static_cast<int>(msb(denominator(size)));
  while (size < power_of_two(exponent)) --exponent;
  while (size >= power_of_two(exponent + 1)) ++exponent;
  const Rational scaled = size * power_of_two(52 - exponent);  // in [2^52, 2^53)
  Integer whole = numerator(scaled) / denominator(scaled);
  const Rational rest = scaled - Rational(whole);
  const Rational half(1, 2);
  if (rest > half || (rest == half && (whole & 1) != 0)) ++whole;
  const double result = std::ldexp(static_cast<double>(static_cast<std::uint64_t>(whole)), exponent - 52);
  return value < 0 ? -result : result;
}

}  // namespace

MomentsByDefinition moments_by_definition(std::span<const float> values) {
  const auto n = static_cast<std::int64_t>(values.size());
  if (n == 0) return {extract::kUndefined, 0};
  Rational sum = 0;
  for (const float value : values) sum += exactly(value);
  const Rational mean = sum / n;
  if (n == 1) return {nearest(mean), 0};
  Rational deviations = 0;
  for (const float value : values) {
    const Rational deviation = exactly(value) - mean;
    deviations += deviation * deviation;
  }
  return {nearest(mean), nearest(deviations / (n - 1))};
}

extract::FaceStatistics statistics_by_definition(std::span<const survey::Index> voxels,
                                                 const survey::Index& dims, const ValueAt& value,
                                                 double max_abs, extract::Outside outside) {
  const survey::Box survey_box{{0, 0, 0}, dims};
  extract::FaceStatistics face;
  face.outside = outside;
  std::vector<float> values;
  Integer all_num = 0;
  Integer all_den = 0;
  for (const survey::Index& voxel : voxels) {
    const float own = value(voxel);
    if (std::isfinite(own)) {
      values.push_back(own);
    } else {
      ++face.nulls;
    }
    double sum = 0;
    double squares = 0;
    int m = 0;
    for (int di = -1; di <= 1; ++di) {
      for (int dj = -1; dj <= 1; ++dj) {
        const survey::Index neighbour{voxel[0] + di, voxel[1] + dj, voxel[2]};
        if (!survey_box.contains(neighbour)) continue;
        const double v = value(neighbour);
        if (!std::isfinite(v)) continue;
        sum += v;
        squares += v * v;
        ++m;
      }
    }
    if (m < 4 || max_abs == 0) continue;
    const double unit = std::ldexp(1.0, 40) / (81 * (max_abs * max_abs));
    all_num += Integer(std::nearbyint(sum * sum * unit));
    all_den += Integer(std::nearbyint(m * squares * unit));
  }
  face.count = static_cast<std::int64_t>(values.size());
  const MomentsByDefinition moments = moments_by_definition(values);
  face.mean = moments.mean;
  face.variance = moments.variance;
  if (!values.empty()) {
    face.min = *std::min_element(values.begin(), values.end()) + 0.0;
    face.max = *std::max_element(values.begin(), values.end()) + 0.0;
  }
  if (all_den != 0) {
    const Integer difference = all_num > all_den ? Integer(0) : Integer(all_den - all_num);
    face.discontinuity = nearest(Rational(difference)) / nearest(Rational(all_den));
  }
  return face;
}

}  // namespace footwall::verify
