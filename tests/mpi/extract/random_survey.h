// A survey of random values and random faces, the same on every rank: the generator's numbers are the
// standard's, the rest is integer arithmetic.
#pragma once
#include <random>

#include "mpi/extract/same_bits.h"
#include "mpi/extract/survey_case.h"

namespace footwall::extract {

struct RandomSurvey : Case {
  RandomSurvey(const survey::Index& its_dims, unsigned seed) : Case{its_dims, {}, {}, 0}, random(seed) {
    fill_with_awkward_values(*this, random);
  }

  // Anywhere near the survey, some beyond its border, some far away; some are segments and points.
  survey::LatticeTriangle triangle() {
    survey::LatticeTriangle t{};
    const std::int64_t beyond = random() % 4 == 0 ? 5 : 0;
    const auto coordinate = [&](std::size_t axis) {
      const auto span = static_cast<std::uint64_t>((dims[axis] + 2 * beyond) * 256);
      return static_cast<std::int32_t>(static_cast<std::int64_t>(random() % span) - beyond * 256 - 128);
    };
    for (survey::LatticePoint& p : t) p = {coordinate(0), coordinate(1), coordinate(2)};
    if (random() % 13 == 0) t[2] = t[1];
    if (random() % 17 == 0) t[1] = t[2] = t[0];
    if (random() % 29 == 0) {
      for (survey::LatticePoint& p : t) p.i += 1 << 24;
    }
    return t;
  }

  std::mt19937_64 random;
};

}  // namespace footwall::extract
