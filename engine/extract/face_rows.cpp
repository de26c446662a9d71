#include "engine/extract/face_rows.h"

namespace footwall::extract {

void FaceRows::row(const voxelize::Row& row) {
  heads_.push_back({row.u_axis, row.v_axis, row.w_axis, row.u0, row.v, lo_.size(), row.lo.size()});
  lo_.insert(lo_.end(), row.lo.begin(), row.lo.end());
  hi_.insert(hi_.end(), row.hi.begin(), row.hi.end());
  voxels_ += voxelize::voxels_in(row);
}

void FaceRows::clear() {
  heads_.clear();
  lo_.clear();
  hi_.clear();
  voxels_ = 0;
}

voxelize::Row FaceRows::at(std::size_t n) const {
  const Head& head = heads_.at(n);
  return {head.u_axis,
          head.v_axis,
          head.w_axis,
          head.u0,
          head.v,
          {lo_.data() + head.first, head.columns},
          {hi_.data() + head.first, head.columns}};
}

}  // namespace footwall::extract
