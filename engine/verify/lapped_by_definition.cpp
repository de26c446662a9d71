#include "engine/verify/lapped_by_definition.h"

#include <cmath>
#include <numbers>

namespace footwall::verify {
namespace {

constexpr long double kPi = std::numbers::pi_v<long double>;

long double dct(std::size_t t, std::size_t k) {
  const long double scale = k == 0 ? std::sqrt(0.125L) : 0.5L;
  return scale * std::cos(static_cast<long double>((2 * t + 1) * k) * kPi / 16);
}

// Where value t - 4 of a mirrored signal of n values is found.
std::size_t mirrored(std::size_t t, std::size_t n) {
  if (t < 4) return 3 - t;
  t -= 4;
  return t < n ? t : 2 * n - 1 - t;
}

}  // namespace

LappedMatrix lapped_matrix(const std::array<long double, 3>& angles) {
  LappedMatrix mixed{};
  for (std::size_t n = 0; n < 4; ++n) {
    for (std::size_t t = 0; t < 8; ++t) {
      const long double here = (dct(t, 2 * n) - dct(t, 2 * n + 1)) / 2;
      const long double there = (dct(7 - t, 2 * n) - dct(7 - t, 2 * n + 1)) / 2;
      mixed[t][n] = here;
      mixed[t][n + 4] = here;
      mixed[t + 8][n] = there;
      mixed[t + 8][n + 4] = -there;
    }
  }
  for (std::size_t r = 0; r < 3; ++r) {
    const long double c = std::cos(angles[r] * kPi);
    const long double s = std::sin(angles[r] * kPi);
    for (auto& row : mixed) {
      const long double a = row[4 + r];
      const long double b = row[5 + r];
      row[4 + r] = c * a - s * b;
      row[5 + r] = s * a + c * b;
    }
  }
  LappedMatrix ordered{};
  for (std::size_t t = 0; t < 16; ++t) {
    for (std::size_t n = 0; n < 8; ++n) ordered[t][n] = mixed[t][n % 2 * 4 + n / 2];
  }
  return ordered;
}

long double distance_from_orthonormal(const LappedMatrix& matrix) {
  long double most = 0;
  for (std::size_t a = 0; a < 8; ++a) {
    for (std::size_t b = 0; b < 8; ++b) {
      long double same = 0;
      long double overlap = 0;
      for (std::size_t t = 0; t < 16; ++t) same += matrix[t][a] * matrix[t][b];
      for (std::size_t t = 0; t < 8; ++t) overlap += matrix[t + 8][a] * matrix[t][b];
      most = std::max({most, std::abs(same - (a == b ? 1 : 0)), std::abs(overlap)});
    }
  }
  return most;
}

long double coding_gain_db(const LappedMatrix& matrix, std::span<const long double> autocorrelation) {
  long double log_of_product = 0;
  for (std::size_t k = 0; k < 8; ++k) {
    long double variance = 0;
    for (std::size_t a = 0; a < 16; ++a) {
      for (std::size_t b = 0; b < 16; ++b) {
        variance += matrix[a][k] * matrix[b][k] * autocorrelation[a < b ? b - a : a - b];
      }
    }
    log_of_product += std::log10(variance);
  }
  return 10 * (std::log10(autocorrelation[0]) - log_of_product / 8);
}

std::vector<long double> lapped_forward(std::span<const long double> values, const LappedMatrix& matrix) {
  const std::size_t n = values.size();
  std::vector<long double> coefficients(n, 0);
  for (std::size_t block = 0; block < n; block += 8) {
    for (std::size_t k = 0; k < 8; ++k) {
      for (std::size_t t = 0; t < 16; ++t) {
        coefficients[block + k] += matrix[t][k] * values[mirrored(block + t, n)];
      }
    }
  }
  return coefficients;
}

std::vector<long double> lapped_inverse(std::span<const long double> coefficients,
                                        const LappedMatrix& matrix) {
  const std::size_t n = coefficients.size();
  std::vector<long double> values(n, 0);
  for (std::size_t block = 0; block < n; block += 8) {
    for (std::size_t k = 0; k < 8; ++k) {
      for (std::size_t t = 0; t < 16; ++t) {
        values[mirrored(block + t, n)] += matrix[t][k] * coefficients[block + k];
      }
    }
  }
  return values;
}

}  // namespace footwall::verify
