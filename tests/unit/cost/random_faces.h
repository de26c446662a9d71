// Faces for the tests of this folder.
#pragma once
#include <random>
#include <vector>

#include "engine/extract/face.h"

namespace footwall::extract {

// Triangles with corners in random cubes of `leg` voxels that lie in the box; with `crowd` in its first
// quarter along inlines.
inline std::vector<Face> random_faces(const survey::Index& dims, std::size_t count, std::int32_t leg,
                                      unsigned seed, bool crowd = false) {
  std::mt19937_64 random(seed);
  const auto below = [&](std::int64_t end) {
    return static_cast<std::int32_t>(random() % static_cast<std::uint64_t>(std::max<std::int64_t>(1, end)));
  };
  std::vector<Face> faces(count);
  for (std::size_t n = 0; n < count; ++n) {
    faces[n].fault = 1;
    faces[n].owner = static_cast<std::int64_t>(n);
    const std::int64_t i = below(((crowd ? dims[0] / 4 : dims[0]) - leg - 1) * 256);
    const std::int64_t j = below((dims[1] - leg - 1) * 256);
    const std::int64_t k = below((dims[2] - leg - 1) * 256);
    for (survey::LatticePoint& p : faces[n].triangle) {
      p = {static_cast<std::int32_t>(i + below(leg * 256)), static_cast<std::int32_t>(j + below(leg * 256)),
           static_cast<std::int32_t>(k + below(leg * 256))};
    }
  }
  return faces;
}

}  // namespace footwall::extract
