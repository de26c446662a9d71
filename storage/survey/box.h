// Boxes of voxels, half-open on every axis: lo <= index < hi.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

namespace footwall::survey {

using Index = std::array<std::int64_t, 3>;  // inline, crossline, sample

struct Box {
  Index lo{0, 0, 0};
  Index hi{0, 0, 0};

  bool empty() const { return lo[0] >= hi[0] || lo[1] >= hi[1] || lo[2] >= hi[2]; }
  std::int64_t size(int axis) const { return std::max<std::int64_t>(0, hi[axis] - lo[axis]); }
  std::int64_t count() const { return size(0) * size(1) * size(2); }
  bool contains(const Index& p) const {
    return p[0] >= lo[0] && p[0] < hi[0] && p[1] >= lo[1] && p[1] < hi[1] && p[2] >= lo[2] && p[2] < hi[2];
  }
  friend bool operator==(const Box&, const Box&) = default;
};

inline Box intersection(const Box& a, const Box& b) {
  Box both;
  for (int axis = 0; axis < 3; ++axis) {
    both.lo[axis] = std::max(a.lo[axis], b.lo[axis]);
    both.hi[axis] = std::min(a.hi[axis], b.hi[axis]);
  }
  return both;
}

inline Box grown(const Box& box, std::int64_t by) {
  return {{box.lo[0] - by, box.lo[1] - by, box.lo[2] - by}, {box.hi[0] + by, box.hi[1] + by, box.hi[2] + by}};
}

}  // namespace footwall::survey
