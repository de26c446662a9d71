// Values that are anything but smooth, some of them null, and random faces.
#pragma once
#include <limits>
#include <random>

#include "engine/extract/face.h"
#include "engine/extract/face_changes.h"
#include "storage/base/splitmix64.h"
#include "storage/survey/box.h"

namespace footwall::service {

inline float made_value(const survey::Index& p) {
  const std::uint64_t bits = mixed(static_cast<std::uint64_t>((p[0] * 97 + p[1]) * 89 + p[2]) * kGolden);
  const auto whole = static_cast<int>(bits % 20001) - 10000;
  return whole % 37 == 0 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(whole) * 0.125F;
}

// In and around a survey of `dims` voxels.
inline extract::Face made_face(std::mt19937& random, const survey::Index& dims, std::int64_t fault,
                               std::int32_t n) {
  extract::Face face{fault, 3, n, {}};
  for (survey::LatticePoint& p : face.triangle) {
    const auto place = [&](std::size_t axis) {
      return static_cast<std::int32_t>(random() % static_cast<unsigned>((dims[axis] + 4) * 256)) - 512;
    };
    p = {place(0), place(1), place(2)};
  }
  return face;
}

}  // namespace footwall::service
