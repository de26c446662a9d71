// The voxels of one face as the spans that the voxelizer emitted, kept for later: 8 bytes a column where a
// list of coordinates takes 12 a voxel.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/voxelize/rows.h"

namespace footwall::extract {

// visit(survey::Index) for every voxel of a row: by ascending column, then w.
template <typename Visit>
void for_each_voxel(const voxelize::Row& row, Visit&& visit) {
  survey::Index voxel{};
  voxel[static_cast<std::size_t>(row.v_axis)] = row.v;
  for (std::size_t c = 0; c < row.lo.size(); ++c) {
    voxel[static_cast<std::size_t>(row.u_axis)] = row.u0 + static_cast<std::int64_t>(c);
    for (std::int64_t w = row.lo[c]; w <= row.hi[c]; ++w) {
      voxel[static_cast<std::size_t>(row.w_axis)] = w;
      visit(voxel);
    }
  }
}

class FaceRows final : public voxelize::RowSink {
 public:
  void row(const voxelize::Row& row) override;
  void clear();

  std::int64_t voxels() const { return voxels_; }
  // The rows in the order in which they came; a row's spans are valid until the next call of row() or
  // clear().
  std::size_t rows() const { return heads_.size(); }
  voxelize::Row at(std::size_t n) const;

  // visit(survey::Index) for every voxel in canonical order: rows, then columns, then w ascending.
  template <typename Visit>
  void for_each(Visit&& visit) const {
    for (std::size_t n = 0; n < rows(); ++n) for_each_voxel(at(n), visit);
  }

 private:
  struct Head {
    int u_axis = 2;
    int v_axis = 1;
    int w_axis = 0;
    std::int64_t u0 = 0;
    std::int64_t v = 0;
    std::size_t first = 0;  // its columns in lo_ and hi_
    std::size_t columns = 0;
  };
  std::vector<Head> heads_;
  std::vector<std::int32_t> lo_;
  std::vector<std::int32_t> hi_;
  std::int64_t voxels_ = 0;
};

}  // namespace footwall::extract
