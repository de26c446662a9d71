// Faces for the tests of balancing: the same on every rank and machine.
#pragma once
#include <random>
#include <vector>

#include "engine/extract/face.h"
#include "storage/survey/box.h"

namespace footwall::extract {

// Some of them alike, without area, or outside the survey; ids ascending, with gaps.
inline std::vector<Face> random_faces(const survey::Index& dims, int count, std::mt19937_64& random) {
  const auto below = [&](std::int64_t limit) {
    return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(limit));
  };
  std::vector<Face> faces;
  for (int n = 0; n < count; ++n) {
    Face face{1 + n / 17, 5 * (n % 17), 3, {}};
    if (n > 0 && below(4) == 0) {
      face.triangle = faces.back().triangle;
    } else {
      // Crowded towards the first corner, of very unlike sizes.
      const std::int64_t size = 1 + below(1 + below(30));
      const survey::Index corner{below(1 + below(dims[0])), below(1 + below(dims[1])), below(dims[2])};
      for (survey::LatticePoint& p : face.triangle) {
        p = {static_cast<std::int32_t>(256 * corner[0] + below(256 * size)),
             static_cast<std::int32_t>(256 * corner[1] + below(256 * size)),
             static_cast<std::int32_t>(256 * corner[2] + below(256 * size))};
      }
      if (below(9) == 0) face.triangle[2] = face.triangle[0];
      if (below(15) == 0) {
        for (survey::LatticePoint& p : face.triangle) p.i -= static_cast<std::int32_t>(256 * below(400));
      }
    }
    faces.push_back(face);
  }
  return faces;
}

}  // namespace footwall::extract
