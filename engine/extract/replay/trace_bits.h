// A set of voxels of a survey, one bit each, in whole traces: what a rank needs of the others.
#pragma once
#include <bit>
#include <cstdint>
#include <vector>

#include "engine/voxelize/rows.h"
#include "storage/survey/box.h"

namespace footwall::extract {

class TraceBits final : public voxelize::RowSink {
 public:
  // Empty. Throws std::bad_alloc.
  explicit TraceBits(const survey::Index& dims)
      : dims_(dims),
        words_(static_cast<std::size_t>((dims[2] + 63) / 64)),
        bits_(static_cast<std::size_t>(dims[0] * dims[1]) * words_, 0) {}

  // Every voxel of the row, which must lie in the survey.
  void row(const voxelize::Row& row) override;
  // Every voxel of a box, as far as it lies in the survey.
  void add(const survey::Box& box);
  // The voxels of another set, of the same survey, in a box of traces.
  void copy(const TraceBits& other, const survey::Box& traces);
  // Empties it; costs no more than the traces between those that were touched.
  void clear();

  // The traces that may hold a voxel; empty where there is none.
  const survey::Box& touched() const { return touched_; }
  std::size_t words() const { return words_; }
  std::uint64_t* trace(std::int64_t i, std::int64_t j) {
    return bits_.data() + static_cast<std::size_t>(i * dims_[1] + j) * words_;
  }
  const std::uint64_t* trace(std::int64_t i, std::int64_t j) const {
    return bits_.data() + static_cast<std::size_t>(i * dims_[1] + j) * words_;
  }
  std::int64_t count(std::int64_t i, std::int64_t j) const {
    const std::uint64_t* trace = this->trace(i, j);
    std::int64_t sum = 0;
    for (std::size_t w = 0; w < words_; ++w) sum += std::popcount(trace[w]);
    return sum;
  }
  // Adds to every voxel those up to `reach` traces away in inline and in crossline direction.
  void grow(std::int64_t reach);
  // Puts in the place of every voxel a block of side^3 voxels, from x - floor(side / 2) on each axis.
  void add_blocks(std::int64_t side);

 private:
  void touch(const survey::Box& box);
  void fill(std::int64_t i, std::int64_t j, std::int64_t first, std::int64_t last);
  // Or-s to every trace those at the distances -after .. +before along an axis.
  void spread(int axis, std::int64_t before, std::int64_t after);

  survey::Index dims_;
  std::size_t words_;
  std::vector<std::uint64_t> bits_;
  survey::Box touched_;
};

}  // namespace footwall::extract
