// A survey with awkward values and faces, the same on every rank, and its statistics by definition.
#pragma once
#include <random>
#include <vector>

#include "engine/verify/statistics_by_definition.h"
#include "engine/verify/voxel_oracle.h"
#include "mpi/extract/same_bits.h"
#include "mpi/extract/survey_case.h"

namespace footwall::extract {

// The same on every rank: the generator's numbers are the standard's, the rest is integer arithmetic.
inline Case random_case(const survey::Index& dims, int faces, unsigned seed) {
  std::mt19937_64 random(seed);
  Case made{dims, {}, {}, 0};
  fill_with_awkward_values(made, random);
  const auto coordinate = [&](std::size_t axis, std::int64_t beyond) {
    const std::int64_t span = (dims[axis] + 2 * beyond) * 256;
    return static_cast<std::int32_t>(static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(span)) -
                                     beyond * 256 - 128);
  };
  for (int n = 0; n < faces; ++n) {
    Face face{7 + n % 3, 100 + n / 3, n, {}};
    const std::int64_t beyond = n % 4 == 0 ? 6 : n % 11 == 3 ? 40 : 0;
    for (survey::LatticePoint& p : face.triangle)
      p = {coordinate(0, beyond), coordinate(1, beyond), coordinate(2, beyond)};
    if (n % 13 == 5) face.triangle[2] = face.triangle[1];                                     // a segment
    if (n % 17 == 6) face.triangle = {face.triangle[0], face.triangle[0], face.triangle[0]};  // a point
    if (n % 5 == 2) {  // on voxel centres and cube faces
      for (survey::LatticePoint& p : face.triangle) p = {p.i / 128 * 128, p.j / 128 * 128, p.k / 256 * 256};
    }
    if (n % 29 == 8) {  // far away
      for (survey::LatticePoint& p : face.triangle) p.i += 1 << 24;
    }
    made.faces.push_back(face);
  }
  return made;
}

// Moves the vertices of a third of the faces by up to 2 voxels along each axis; their places.
inline std::vector<std::size_t> move_some(Case& c, unsigned seed) {
  std::mt19937_64 random(seed);
  std::vector<std::size_t> moved;
  for (std::size_t n = 0; n < c.faces.size(); ++n) {
    if (random() % 3 != 0) continue;
    for (survey::LatticePoint& p : c.faces[n].triangle) {
      p.i += static_cast<std::int32_t>(random() % 1025) - 512;
      p.j += static_cast<std::int32_t>(random() % 1025) - 512;
      p.k += static_cast<std::int32_t>(random() % 1025) - 512;
    }
    moved.push_back(n);
  }
  return moved;
}

inline survey::Box bounding_box(const survey::LatticeTriangle& t, const survey::Index& dims) {
  survey::Box box{{1 << 30, 1 << 30, 1 << 30}, {-(1 << 30), -(1 << 30), -(1 << 30)}};
  for (const survey::LatticePoint& p : t) {
    const survey::Index at{p.i, p.j, p.k};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.lo[axis] = std::min(box.lo[axis], (at[axis] >> 8) - 1);
      box.hi[axis] = std::max(box.hi[axis], (at[axis] >> 8) + 3);
    }
  }
  return survey::intersection(box, {{0, 0, 0}, dims});
}

inline Outside where(const survey::LatticeTriangle& t, const survey::Index& dims, bool touched) {
  if (!touched) return Outside::kWholly;
  for (const survey::LatticePoint& p : t) {
    const double at[3] = {p.i / 256.0, p.j / 256.0, p.k / 256.0};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (at[axis] < -0.5 || at[axis] > static_cast<double>(dims[axis]) - 0.5) return Outside::kPartly;
    }
  }
  return Outside::kInside;
}

inline std::vector<FaceStatistics> by_definition(const Case& c) {
  std::vector<FaceStatistics> all;
  for (const Face& face : c.faces) {
    const survey::Box box = bounding_box(face.triangle, c.dims);
    const auto voxels =
        box.empty() ? std::vector<survey::Index>{} : verify::voxels_by_definition(face.triangle, box);
    all.push_back(verify::statistics_by_definition(
        voxels, c.dims, [&](const survey::Index& p) { return c.at(p); }, c.max_abs,
        where(face.triangle, c.dims, !voxels.empty())));
  }
  return all;
}

}  // namespace footwall::extract
