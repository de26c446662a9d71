// The values of faces that reach beyond a rank's own blocks: from a block where a run of columns lies inside
// it, voxel by voxel from block or cache elsewhere.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "engine/extract/exchange/exchange.h"
#include "engine/extract/fold_rows.h"

namespace footwall::extract {

// Looks values up, NaN outside the survey; remembers the last brick.
class ValueAt {
 public:
  ValueAt(const Blocks& blocks, const VoxelCache& cache, const survey::Index& dims)
      : blocks_(blocks), cache_(cache), dims_(dims) {}

  float operator()(std::int64_t i, std::int64_t j, std::int64_t k) {
    // Negative indices become large ones.
    if (static_cast<std::uint64_t>(i) >= static_cast<std::uint64_t>(dims_[0]) ||
        static_cast<std::uint64_t>(j) >= static_cast<std::uint64_t>(dims_[1])) {
      return std::numeric_limits<float>::quiet_NaN();
    }
    if ((i >> 3) != brick_[0] || (j >> 3) != brick_[1] || (k >> 3) != brick_[2])
      find({i >> 3, j >> 3, k >> 3});
    if (data_ == nullptr) return from_any_block({i, j, k});
    return data_[first_ + (i & 7) * strides_[0] + (j & 7) * strides_[1] + (k & 7)];
  }

 private:
  void find(const survey::Index& brick);
  float from_any_block(const survey::Index& voxel) const;

  const Blocks& blocks_;
  const VoxelCache& cache_;
  survey::Index dims_;
  survey::Index brick_{-1, -1, -1};
  const float* data_ = nullptr;  // that have the brick; null where several blocks have it
  std::int64_t first_ = 0;       // place of the brick's first voxel
  std::array<std::int64_t, 2> strides_{};
};

// Folds a face row by row.
class FaceFolder final : public voxelize::RowSink {
 public:
  explicit FaceFolder(const Setup& setup);
  void row(const voxelize::Row& row) override;
  // What was folded since the last call; ends a face.
  Partial take();

 private:
  void flush();

  bool with_discontinuity_;
  double scale_;
  std::vector<survey::Box> full_;  // of each block: whose voxels it has with their neighbours
  std::vector<std::unique_ptr<RowFolder>> folders_;  // of each block
  std::vector<ValueAt> at_;                          // of each neighbour, so that each has its last brick
  Partial partial_;
  std::size_t used_ = 0;
  std::array<survey::Index, kWindowBlock> voxels_;
  Windows windows_;
};

// The values of a face in canonical order.
class FaceValues {
 public:
  explicit FaceValues(const Setup& setup);
  // Valid until the next call.
  std::span<const float> of(const FaceRows& rows);

 private:
  std::span<const Block> blocks_;
  std::vector<survey::Box> held_;
  ValueAt at_;
  std::vector<float> values_;
};

}  // namespace footwall::extract
