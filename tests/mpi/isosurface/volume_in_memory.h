// Volumes for tests of isosurfaces over ranks: every rank can make any sample of them.
#pragma once
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "engine/isosurface/parallel/extract_parallel.h"
#include "storage/base/splitmix64.h"

namespace footwall::isosurface {

using Value = std::function<float(const survey::Index&)>;

struct TestVolume {
  survey::Index dims{1, 1, 1};
  Value value;

  std::vector<float> samples(const survey::Box& box) const {
    std::vector<float> values;
    values.reserve(static_cast<std::size_t>(box.count()));
    for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
      for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
        for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) values.push_back(value({i, j, k}));
      }
    }
    return values;
  }
  Field whole(std::vector<float>& room) const {
    room = samples({{0, 0, 0}, dims});
    return {room, dims, {0, 0, 0}, dims};
  }
};

// Hands out just the box that is asked for, so that what lies beyond it cannot be used.
inline FieldOf field_of(const TestVolume& volume, std::vector<float>& room) {
  return [&volume, &room](const survey::Box& box) {
    room = volume.samples(box);
    return Field{room, {box.size(0), box.size(1), box.size(2)}, box.lo, volume.dims};
  };
}

// Smooth enough to have large components, rough enough to have every case; whole numbers, so that some
// samples equal the isovalue 0.
inline Value rough(std::uint64_t seed, double nulls) {
  return [seed, nulls](const survey::Index& p) {
    const auto at = [&](std::int64_t scale) {
      std::uint64_t n = seed;
      for (int axis = 0; axis < 3; ++axis)
        n = mixed(n + kGolden * static_cast<std::uint64_t>(p[axis] / scale + 1));
      return SplitMix64(n).unit();
    };
    if (at(1) < nulls) return std::numeric_limits<float>::quiet_NaN();
    const double v = 3 * at(5) + 2 * at(2) + at(1) - 3;
    return static_cast<float>(static_cast<int>(v * 4));
  };
}

// The min/max pyramid's level 0 by its definition.
struct TestBricks {
  std::vector<float> min, max;
  std::vector<std::uint8_t> has_null;
  Bricks bricks;

  explicit TestBricks(const TestVolume& volume) {
    constexpr std::int64_t kBrick = 8;
    for (int axis = 0; axis < 3; ++axis)
      bricks.dims[axis] = std::max<std::int64_t>(1, (volume.dims[axis] - 1 + kBrick - 1) / kBrick);
    for (std::int64_t a = 0; a < bricks.dims[0]; ++a) {
      for (std::int64_t b = 0; b < bricks.dims[1]; ++b) {
        for (std::int64_t c = 0; c < bricks.dims[2]; ++c) {
          const survey::Box all{{0, 0, 0}, volume.dims};
          const survey::Box some = intersection(
              all, {{a * kBrick, b * kBrick, c * kBrick}, {a * kBrick + 9, b * kBrick + 9, c * kBrick + 9}});
          float lo = std::numeric_limits<float>::infinity();
          float hi = -lo;
          bool null = false;
          for (const float v : volume.samples(some)) {
            null = null || v != v;
            lo = v < lo ? v : lo;
            hi = v > hi ? v : hi;
          }
          min.push_back(lo);
          max.push_back(hi);
          has_null.push_back(null ? 1 : 0);
        }
      }
    }
    bricks.min = min;
    bricks.max = max;
    bricks.has_null = has_null;
  }
};

}  // namespace footwall::isosurface
