#include "engine/isosurface/visible/parallel/brick_pillars.h"

#include <algorithm>

namespace footwall::isosurface {

std::vector<survey::Box> bricks_of_rank(const survey::Index& volume, int ranks, int rank,
                                        const Interleaving& interleaving) {
  // Bricks are dealt out as cells are, of a volume with as many of them.
  survey::Index bricks{};
  for (int axis = 0; axis < 3; ++axis) bricks[axis] = std::max<std::int64_t>(1, (volume[axis] + 6) / 8) + 1;
  return Pillars(bricks, ranks, interleaving).of_rank(rank);
}

survey::Box samples_of_bricks(const survey::Box& bricks, const survey::Index& volume) {
  survey::Box samples;
  for (int axis = 0; axis < 3; ++axis) {
    samples.lo[axis] = std::max<std::int64_t>(0, 8 * bricks.lo[axis] - 1);
    samples.hi[axis] = std::min(8 * bricks.hi[axis] + 2, volume[axis]);
  }
  return samples;
}

std::int64_t BrickPillars::memory_bytes() const {
  std::size_t bytes = 0;
  for (const PageVector<float>& values : values_) bytes += values.room_bytes();
  return static_cast<std::int64_t>(bytes);
}

BrickPillars::BrickPillars(const Field& volume, int ranks, int rank, const Interleaving& interleaving) {
  for (const survey::Box& bricks : bricks_of_rank(volume.volume_size, ranks, rank, interleaving))
    parts_.push_back({volume, bricks});
}

BrickPillars::BrickPillars(const FieldOf& field_of, const survey::Index& volume, int ranks, int rank,
                           const Interleaving& interleaving) {
  for (const survey::Box& bricks : bricks_of_rank(volume, ranks, rank, interleaving)) {
    const survey::Box samples = samples_of_bricks(bricks, volume);
    const Field read = field_of(samples);
    PageVector<float>& values = values_.emplace_back();
    values.resize_uninitialised(static_cast<std::size_t>(samples.count()));
    float* to = values.data();
    for (std::int64_t i = samples.lo[0]; i < samples.hi[0]; ++i) {
      for (std::int64_t j = samples.lo[1]; j < samples.hi[1]; ++j) {
        const std::int64_t row = (i - read.origin[0]) * read.size[1] + j - read.origin[1];
        const float* const from = read.values.data() + row * read.size[2] + samples.lo[2] - read.origin[2];
        to = std::copy_n(from, samples.size(2), to);
      }
    }
    parts_.push_back(
        {{values.all(), {samples.size(0), samples.size(1), samples.size(2)}, samples.lo, volume}, bricks});
  }
}

}  // namespace footwall::isosurface
