#include "storage/volume/chunk_grid.h"

#include <bit>
#include <limits>

#include "storage/base/error.h"

namespace footwall::volume {
namespace {

// On the bits, so that it vectorizes to compares and blends: all exponent bits set is NaN or infinite.
inline float cleaned(float value, float null_value) {
  constexpr std::uint32_t kExponent = 0x7f800000U;
  constexpr float kNull = std::numeric_limits<float>::quiet_NaN();
  const float finite = (std::bit_cast<std::uint32_t>(value) & kExponent) == kExponent ? kNull : value;
  return value == null_value ? kNull : finite;
}

void copy_row(const float* __restrict from, float* __restrict to, std::int64_t count, float null_value) {
  for (std::int64_t k = 0; k < count; ++k) to[k] = cleaned(from[k], null_value);
}

}  // namespace

survey::Box ChunkGrid::box_of(const survey::Index& c) const {
  survey::Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lo[axis] = c[axis] * chunk[axis];
    box.hi[axis] = std::min(box.lo[axis] + chunk[axis], dims[axis]);
  }
  return box;
}

survey::Box ChunkGrid::full_box_of(const survey::Index& c) const {
  survey::Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lo[axis] = c[axis] * chunk[axis];
    box.hi[axis] = box.lo[axis] + chunk[axis];
  }
  return box;
}

survey::Box ChunkGrid::touched_by(const survey::Box& box) const {
  if (box.empty()) return {};
  survey::Box touched;
  for (int axis = 0; axis < 3; ++axis) {
    touched.lo[axis] = box.lo[axis] / chunk[axis];
    touched.hi[axis] = (box.hi[axis] - 1) / chunk[axis] + 1;
  }
  return touched;
}

void require_box(const ChunkGrid& grid, const survey::Box& box, std::size_t values) {
  const survey::Box volume{{0, 0, 0}, grid.dims};
  require(box.empty() || intersection(box, volume) == box, "a box inside the volume");
  require(values == static_cast<std::size_t>(box.count()), "as many values as the box has voxels");
}

void copy_clean(const survey::Box& part, const survey::Box& from_box, const float* from,
                const survey::Box& to_box, float* to, float null_value) {
  const auto offset = [](const survey::Box& box, std::int64_t i, std::int64_t j, std::int64_t k) {
    return ((i - box.lo[0]) * box.size(1) + (j - box.lo[1])) * box.size(2) + (k - box.lo[2]);
  };
  for (std::int64_t i = part.lo[0]; i < part.hi[0]; ++i) {
    for (std::int64_t j = part.lo[1]; j < part.hi[1]; ++j) {
      copy_row(from + offset(from_box, i, j, part.lo[2]), to + offset(to_box, i, j, part.lo[2]), part.size(2),
               null_value);
    }
  }
}

void clean_in_place(std::span<float> values, float null_value) {
  for (float& value : values) value = cleaned(value, null_value);
}

}  // namespace footwall::volume
