#include "engine/voxelize/detail/voxel_set.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "storage/base/error.h"

namespace footwall::voxelize::detail {
namespace {

constexpr std::int32_t kMiddle = 16;  // the bit of a column's first voxel

}  // namespace

void VoxelSet::assign(std::span<const Voxel> voxels, int u_axis, int v_axis, int w_axis) {
  u_ = static_cast<std::size_t>(u_axis);
  v_ = static_cast<std::size_t>(v_axis);
  w_ = static_cast<std::size_t>(w_axis);
  make_lines(voxels);
  for (const Voxel& voxel : voxels) add(voxel);
}

void VoxelSet::assign(std::span<const Voxel> voxels, int u_axis, int v_axis, int w_axis,
                      std::vector<Voxel>& firsts) {
  u_ = static_cast<std::size_t>(u_axis);
  v_ = static_cast<std::size_t>(v_axis);
  w_ = static_cast<std::size_t>(w_axis);
  make_lines(voxels);
  for (const Voxel& voxel : voxels) {
    if (add(voxel)) firsts.push_back(voxel);
  }
}

void VoxelSet::make_lines(std::span<const Voxel> voxels) {
  lines_.clear();
  cells_.clear();
  if (voxels.empty()) return;
  std::int32_t least = std::numeric_limits<std::int32_t>::max();
  std::int32_t most = std::numeric_limits<std::int32_t>::min();
  for (const Voxel& voxel : voxels) {
    least = std::min(least, voxel[v_]);
    most = std::max(most, voxel[v_]);
  }
  v0_ = least;
  lines_.assign(static_cast<std::size_t>(std::int64_t{most} - least + 1), Line{});
  for (const Voxel& voxel : voxels) {
    Line& line = lines_[static_cast<std::size_t>(voxel[v_] - v0_)];
    const std::int32_t u = voxel[u_];
    if (line.first > line.last) {
      line.first = line.last = u;
    } else {
      line.first = std::min(line.first, u);
      line.last = std::max(line.last, u);
    }
  }
  std::int64_t cells = 0;
  std::int64_t longest = 0;
  for (Line& line : lines_) {
    line.cells = cells;
    const std::int64_t length = std::int64_t{line.last} - line.first + 1;
    cells += length;
    longest = std::max(longest, length);
  }
  cells_.assign(static_cast<std::size_t>(cells), Cell{});
  if (static_cast<std::size_t>(longest) > lo_.size()) {
    lo_.resize(static_cast<std::size_t>(longest));
    hi_.resize(static_cast<std::size_t>(longest));
  }
}

bool VoxelSet::add(const Voxel& voxel) {
  const Line& line = lines_[static_cast<std::size_t>(voxel[v_] - v0_)];
  Cell& cell = cells_[static_cast<std::size_t>(line.cells + (voxel[u_] - line.first))];
  const std::int32_t w = voxel[w_];
  if (cell.members == 0) cell.base = w - kMiddle;
  const std::int32_t bit = w - cell.base;
  require(bit >= 0 && bit < 32, "voxels near a plane");
  const std::uint32_t member = 1U << bit;
  const bool fresh = (cell.members & member) == 0;
  cell.members |= member;
  return fresh;
}

void VoxelSet::emit(RowSink& sink) {
  Row row{static_cast<int>(u_), static_cast<int>(v_), static_cast<int>(w_), 0, 0, {}, {}};
  for (std::size_t n = 0; n < lines_.size(); ++n) {
    const Line& line = lines_[n];
    if (line.first > line.last) continue;
    row.v = std::int64_t{v0_} + static_cast<std::int64_t>(n);
    std::int32_t begins = line.first;
    std::size_t used = 0;
    const auto send = [&] {
      row.u0 = begins;
      row.lo = {lo_.data(), used};
      row.hi = {hi_.data(), used};
      sink.row(row);
    };
    for (std::int32_t u = line.first; u <= line.last; ++u) {
      const Cell& cell = cells_[static_cast<std::size_t>(line.cells + (u - line.first))];
      if (cell.members == 0) {
        lo_[used] = 0;
        hi_[used++] = -1;
        continue;
      }
      std::uint32_t members = cell.members;
      std::int32_t at = cell.base;
      for (;;) {
        const int skipped = std::countr_zero(members);
        members >>= skipped;
        const int length = std::countr_one(members);
        at += skipped;
        lo_[used] = at;
        hi_[used++] = at + length - 1;
        at += length;
        members = length == 32 ? 0 : members >> length;
        if (members == 0) break;
        send();
        begins = u;
        used = 0;
      }
    }
    send();
  }
}

}  // namespace footwall::voxelize::detail
