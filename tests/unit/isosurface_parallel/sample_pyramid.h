// The finest level of a min/max pyramid, made for tests without a volume.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/isosurface/extract.h"

namespace footwall::isosurface {

struct Pyramid {
  std::vector<float> min, max;
  std::vector<std::uint8_t> has_null;
  Bricks bricks;

  // is_active(brick): whether the isovalue 0 crosses it; asked in the order of the table.
  template <class IsActive>
  Pyramid(const survey::Index& dims, IsActive&& is_active) {
    bricks.dims = dims;
    for (std::int64_t a = 0; a < dims[0]; ++a) {
      for (std::int64_t b = 0; b < dims[1]; ++b) {
        for (std::int64_t c = 0; c < dims[2]; ++c) {
          min.push_back(is_active(survey::Index{a, b, c}) ? -1 : 1);
          max.push_back(2);
          has_null.push_back(0);
        }
      }
    }
    bricks.min = min;
    bricks.max = max;
    bricks.has_null = has_null;
  }
  Pyramid(const Pyramid&) = delete;
  Pyramid& operator=(const Pyramid&) = delete;
};

}  // namespace footwall::isosurface
