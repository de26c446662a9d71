// The voxels of a workload: a hash of a voxel's index, so that they need no file and are the same for any
// rank count.
#pragma once
#include <cstdint>
#include <span>

#include "storage/survey/box.h"

namespace footwall::tasks {

// Even in [-1, 1), multiples of 2^-23; `index` counts voxels in [inline][crossline][sample] order.
float hashed_value(std::uint64_t index, std::uint64_t seed);

// The values of a box of a survey of `dims` voxels, [inline][crossline][sample].
void fill_hashed(const survey::Index& dims, std::uint64_t seed, const survey::Box& box,
                 std::span<float> values);

}  // namespace footwall::tasks
