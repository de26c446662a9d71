// Bresenham's line (seed 004, appendix E.1), in two and three dimensions.
#pragma once
#include <array>
#include <cstdint>
#include <cstdlib>

namespace footwall::voxelize::detail {

// Calls visit(x, y) for each pixel of the line from (x0, y0) to (x1, y1), both included, in that order.
template <class Visit>
void bresenham(std::int64_t x0, std::int64_t y0, std::int64_t x1, std::int64_t y1, Visit&& visit) {
  const std::int64_t dx = std::abs(x1 - x0);
  const std::int64_t dy = std::abs(y1 - y0);
  const std::int64_t x_step = x1 < x0 ? -1 : 1;
  const std::int64_t y_step = y1 < y0 ? -1 : 1;
  const bool steep = dy > dx;  // then x and y change places
  const std::int64_t run = steep ? dy : dx;
  const std::int64_t rise = steep ? dx : dy;
  std::int64_t error = 2 * rise - run;
  std::int64_t x = x0;
  std::int64_t y = y0;
  for (std::int64_t n = 0; n <= run; ++n) {
    visit(x, y);
    if (error > 0) {
      (steep ? x : y) += steep ? x_step : y_step;
      error -= 2 * run;
    }
    (steep ? y : x) += steep ? y_step : x_step;
    error += 2 * rise;
  }
}

// The same for voxels; the axis of the greatest extent (the lowest of equal ones) takes a step each time.
template <class Visit>
void bresenham(const std::array<std::int64_t, 3>& from, const std::array<std::int64_t, 3>& to,
               Visit&& visit) {
  std::array<std::int64_t, 3> extent;
  std::array<std::int64_t, 3> step;
  std::size_t lead = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    extent[axis] = std::abs(to[axis] - from[axis]);
    step[axis] = to[axis] < from[axis] ? -1 : 1;
    if (extent[axis] > extent[lead]) lead = axis;
  }
  std::array<std::int64_t, 3> error;
  for (std::size_t axis = 0; axis < 3; ++axis) error[axis] = 2 * extent[axis] - extent[lead];
  std::array<std::int64_t, 3> at = from;
  for (std::int64_t n = 0; n <= extent[lead]; ++n) {
    visit(at);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (axis == lead) {
        at[axis] += step[axis];
        continue;
      }
      if (error[axis] > 0) {
        at[axis] += step[axis];
        error[axis] -= 2 * extent[lead];
      }
      error[axis] += 2 * extent[axis];
    }
  }
}

}  // namespace footwall::voxelize::detail
