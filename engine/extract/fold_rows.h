// Folds the voxels of a face that lie in a block into partial sums, row by row as the voxelizer emits them:
// places are collected in a buffer that stays in the cache, and the values behind them are folded a buffer at
// a time.
#pragma once
#include "engine/extract/block.h"
#include "engine/extract/statistics/partial.h"
#include "engine/voxelize/rows.h"

namespace footwall::extract {

class RowFolder final : public voxelize::RowSink {
 public:
  // scale: discontinuity_scale(); with_discontinuity needs the block's halo.
  RowFolder(const Block& block, bool with_discontinuity, double scale);

  void row(const voxelize::Row& row) override;
  // One voxel, by its place in the block.
  void place(std::int64_t place) {
    if (used_ == capacity_) flush();
    places_[used_++] = place;
  }
  // What was folded since the last call; ends a face.
  Partial take();

 private:
  void flush();

  static constexpr std::int64_t kColumn = 4;  // places written at once; longer columns are rare
  const Block& block_;
  bool with_discontinuity_;
  double scale_;
  std::size_t capacity_;  // places folded at once
  std::size_t used_ = 0;
  Partial partial_;
  alignas(64) std::int64_t places_[kBlockValues];
  alignas(64) float values_[kBlockValues + kBlockPadding];
  Windows windows_;
};

}  // namespace footwall::extract
