#include "engine/extract/exchange/face_folder.h"

#include <algorithm>

#include "engine/extract/face_rows.h"
#include "storage/base/error.h"

namespace footwall::extract {
namespace {

voxelize::Row columns_of(const voxelize::Row& row, std::size_t first, std::size_t count) {
  voxelize::Row part = row;
  part.u0 += static_cast<std::int64_t>(first);
  part.lo = row.lo.subspan(first, count);
  part.hi = row.hi.subspan(first, count);
  return part;
}

// Splits a row into runs of columns that lie in one of the boxes, or in none: visit(box or -1, Row).
template <typename Visit>
void for_each_run(const voxelize::Row& row, std::span<const survey::Box> boxes, Visit&& visit) {
  const auto u = static_cast<std::size_t>(row.u_axis);
  const auto v = static_cast<std::size_t>(row.v_axis);
  const auto w = static_cast<std::size_t>(row.w_axis);
  const std::size_t columns = row.lo.size();
  const auto inside = [&](const survey::Box& box, std::size_t c) {
    const std::int64_t at = row.u0 + static_cast<std::int64_t>(c);
    return row.v >= box.lo[v] && row.v < box.hi[v] && at >= box.lo[u] && at < box.hi[u] &&
           row.lo[c] >= box.lo[w] && row.hi[c] < box.hi[w];
  };
  const auto box_of = [&](std::size_t c) {
    const auto found =
        std::find_if(boxes.begin(), boxes.end(), [&](const survey::Box& box) { return inside(box, c); });
    return found == boxes.end() ? -1 : static_cast<int>(found - boxes.begin());
  };
  for (std::size_t first = 0; first < columns;) {
    const int box = box_of(first);
    std::size_t last = first + 1;
    if (box >= 0) {
      while (last < columns && inside(boxes[static_cast<std::size_t>(box)], last)) ++last;
    } else {
      while (last < columns && box_of(last) < 0) ++last;
    }
    visit(box, columns_of(row, first, last - first));
    first = last;
  }
}

}  // namespace

void ValueAt::find(const survey::Index& brick) {
  brick_ = brick;
  data_ = cache_.brick(brick);
  first_ = 0;
  strides_ = {64, 8};
  if (data_ != nullptr) return;
  const survey::Index first{brick[0] * 8, brick[1] * 8, brick[2] * 8};
  const std::span<const Block> all = blocks_.all();
  for (const Block& block : all) {
    if (all.size() > 1 && !(block.has(first) && block.has({first[0] + 7, first[1] + 7, first[2]}))) continue;
    data_ = block.data();
    first_ = block.offset(first);
    strides_ = {block.strides()[0], block.strides()[1]};
    return;
  }
}

float ValueAt::from_any_block(const survey::Index& voxel) const {
  const Block* block = blocks_.holding(voxel);
  require(block != nullptr, "a voxel that is here");
  return block->data()[block->offset(voxel)];
}

FaceFolder::FaceFolder(const Setup& setup)
    : with_discontinuity_(setup.with_discontinuity), scale_(setup.scale) {
  for (const Block& block : setup.blocks.all()) {
    full_.push_back(setup.reach() > 0 ? block.own() : block.wanted());
    folders_.push_back(std::make_unique<RowFolder>(block, with_discontinuity_, scale_));
  }
  for (std::size_t k = 0; k < (with_discontinuity_ ? kNeighbours : 1); ++k) {
    at_.emplace_back(setup.blocks, setup.cache, setup.input.dims);
  }
}

void FaceFolder::row(const voxelize::Row& row) {
  for_each_run(row, full_, [&](int box, const voxelize::Row& run) {
    if (box >= 0) {
      folders_[static_cast<std::size_t>(box)]->row(run);
    } else {
      for_each_voxel(run, [&](const survey::Index& voxel) {
        voxels_[used_++] = voxel;
        if (used_ == voxels_.size()) flush();
      });
    }
  });
}

void FaceFolder::flush() {
  const std::size_t centre = kNeighbours / 2;
  if (!with_discontinuity_) {
    for (std::size_t n = 0; n < used_; ++n) {
      windows_.value[centre][n] = at_[0](voxels_[n][0], voxels_[n][1], voxels_[n][2]);
    }
    fold(std::span(windows_.value[centre], used_), partial_.moments);
  } else {
    for (std::size_t k = 0; k < kNeighbours; ++k) {
      const std::int64_t di = static_cast<std::int64_t>(k / 3) - 1;
      const std::int64_t dj = static_cast<std::int64_t>(k % 3) - 1;
      for (std::size_t n = 0; n < used_; ++n) {
        windows_.value[k][n] = at_[k](voxels_[n][0] + di, voxels_[n][1] + dj, voxels_[n][2]);
      }
    }
    fold(std::span(windows_.value[centre], used_), partial_.moments);
    fold_windows(windows_, used_, scale_, partial_.discontinuity);
  }
  used_ = 0;
}

Partial FaceFolder::take() {
  if (used_ > 0) flush();
  Partial result = partial_;
  partial_ = {};
  for (const auto& folder : folders_) result.merge(folder->take());
  return result;
}

FaceValues::FaceValues(const Setup& setup)
    : blocks_(setup.blocks.all()), at_(setup.blocks, setup.cache, setup.input.dims) {
  for (const Block& block : blocks_) held_.push_back(block.wanted());
}

std::span<const float> FaceValues::of(const FaceRows& rows) {
  values_.resize(static_cast<std::size_t>(rows.voxels()));
  float* out = values_.data();
  for (std::size_t r = 0; r < rows.rows(); ++r) {
    for_each_run(rows.at(r), held_, [&](int box, const voxelize::Row& run) {
      if (box < 0) {
        for_each_voxel(run, [&](const survey::Index& voxel) { *out++ = at_(voxel[0], voxel[1], voxel[2]); });
        return;
      }
      const Block& block = blocks_[static_cast<std::size_t>(box)];
      survey::Index first{};
      first[static_cast<std::size_t>(run.v_axis)] = run.v;
      first[static_cast<std::size_t>(run.u_axis)] = run.u0;
      const std::int64_t u_stride = block.strides()[static_cast<std::size_t>(run.u_axis)];
      const std::int64_t w_stride = block.strides()[static_cast<std::size_t>(run.w_axis)];
      const float* column = block.data();
      std::int64_t at = block.offset(first);
      for (std::size_t c = 0; c < run.lo.size(); ++c, at += u_stride) {
        for (std::int64_t w = run.lo[c]; w <= run.hi[c]; ++w) *out++ = column[at + w * w_stride];
      }
    });
  }
  return values_;
}

}  // namespace footwall::extract
