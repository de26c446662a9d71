#include "engine/synthetic/fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "engine/synthetic/detail/arithmetic.h"
#include "engine/synthetic/detail/random.h"
#include "storage/base/error.h"

namespace footwall::synthetic {
namespace {

constexpr std::int64_t kLargest = 2048;

// row(i, j, values): the samples of one row.
template <class Row>
std::vector<float> by_rows(std::int64_t size, Row&& row) {
  std::vector<float> values(static_cast<std::size_t>(size * size * size));
#pragma omp parallel for
  for (std::int64_t i = 0; i < size; ++i) {
    for (std::int64_t j = 0; j < size; ++j) row(i, j, values.data() + (i * size + j) * size);
  }
  return values;
}

SampledField sphere(std::int64_t size) {
  const double centre = static_cast<double>(size - 1) / 2, radius = 0.4 * static_cast<double>(size);
  const auto square = [&](std::int64_t n) {
    const double distance = static_cast<double>(n) - centre;
    return distance * distance;
  };
  return {by_rows(size,
                  [&](std::int64_t i, std::int64_t j, float* row) {
                    const double across = square(i) + square(j);
                    for (std::int64_t k = 0; k < size; ++k) {
                      row[k] = static_cast<float>(radius - std::sqrt(across + square(k)));
                    }
                  }),
          0};
}

SampledField gyroid(std::int64_t size) {
  constexpr double kPeriods = 8.38;
  std::vector<float> sine(static_cast<std::size_t>(size)), cosine(sine.size());
  for (std::size_t n = 0; n < sine.size(); ++n) {
    const double turns = kPeriods * static_cast<double>(n) / static_cast<double>(size);
    sine[n] = static_cast<float>(detail::sine_of_turns(turns));
    cosine[n] = static_cast<float>(detail::sine_of_turns(turns + 0.25));
  }
  return {by_rows(size,
                  [&](std::int64_t i, std::int64_t j, float* row) {
                    for (std::int64_t k = 0; k < size; ++k) {
                      row[k] = sine[k] * cosine[j] + sine[j] * cosine[i] + sine[i] * cosine[k];
                    }
                  }),
          0};
}

// cos + i sin of each sample of an axis, times a factor.
struct Phases {
  Phases(std::int64_t size, double turns_a_sample, double turns, double factor) {
    for (std::int64_t n = 0; n < size; ++n) {
      const double at = turns_a_sample * static_cast<double>(n) + turns;
      real.push_back(static_cast<float>(factor * detail::sine_of_turns(at + 0.25)));
      imaginary.push_back(static_cast<float>(factor * detail::sine_of_turns(at)));
    }
  }
  std::vector<float> real, imaginary;
};

SampledField envelope(std::int64_t size) {
  constexpr int kWaves = 40;
  constexpr double kLongest = 110;  // samples, of the periods along i and j
  std::vector<std::array<Phases, 3>> waves;
  detail::Draws draws(1, 1);
  for (int n = 0; n < kWaves; ++n) {
    const double period = draws.between(8, 28), dip_i = draws.between(-1, 1) / kLongest,
                 dip_j = draws.between(-1, 1) / kLongest, turns = draws.between(0, 1),
                 amplitude = draws.between(0.5, 1.5);
    waves.push_back(
        {Phases(size, dip_i, 0, 1), Phases(size, dip_j, 0, 1), Phases(size, 1 / period, turns, amplitude)});
  }
  SampledField field;
  field.values = by_rows(size, [&](std::int64_t i, std::int64_t j, float* row) {
    std::vector<float> real(static_cast<std::size_t>(size)), imaginary(real.size());
    for (const auto& [along_i, along_j, along_k] : waves) {
      const float re = along_i.real[i] * along_j.real[j] - along_i.imaginary[i] * along_j.imaginary[j];
      const float im = along_i.real[i] * along_j.imaginary[j] + along_i.imaginary[i] * along_j.real[j];
      for (std::size_t k = 0; k < real.size(); ++k) {
        real[k] += re * along_k.real[k] - im * along_k.imaginary[k];
        imaginary[k] += re * along_k.imaginary[k] + im * along_k.real[k];
      }
    }
    for (std::size_t k = 0; k < real.size(); ++k) {
      row[k] = std::sqrt(real[k] * real[k] + imaginary[k] * imaginary[k]);
    }
  });
  double sum = 0;
  for (const float value : field.values) sum += value;
  field.isovalue = static_cast<float>(1.9 * sum / static_cast<double>(field.values.size()));
  return field;
}

constexpr std::array kKinds = {
    FieldKind{"sphere", "one smooth surface", sphere},
    FieldKind{"gyroid", "a surface with many triangles", gyroid},
    FieldKind{"envelope", "many small bodies, as of strong reflectors", envelope},
};

}  // namespace

std::span<const FieldKind> field_kinds() {
  return kKinds;
}

SampledField make_field(std::string_view name, std::int64_t size) {
  if (size < 2 || size > kLargest) {
    throw Error(ErrorCode::kUsage, fmt::format("a volume of {0} x {0} x {0} samples is not made", size),
                fmt::format("give a size of 2 to {}", kLargest));
  }
  std::string names;
  for (const FieldKind& kind : kKinds) {
    if (kind.name == name) return kind.make(size);
    names += fmt::format("{}{}", names.empty() ? "" : ", ", kind.name);
  }
  throw Error(ErrorCode::kUsage, fmt::format("there is no synthetic volume '{}'", name),
              "use one of: " + names);
}

}  // namespace footwall::synthetic
