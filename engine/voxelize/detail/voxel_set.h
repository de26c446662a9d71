// A list of voxels near a plane, in any order and with repetitions, as a set that comes out in rows.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/voxelize/rows.h"

namespace footwall::voxelize::detail {

class VoxelSet {
 public:
  // Takes the list. All voxels of a column (u, v) must lie within 15 of each other along w, which they do for
  // a plane whose normal is longest along w; throws a broken precondition otherwise. Memory: 8 bytes for each
  // column of each row, between the row's first and last.
  void assign(std::span<const Voxel> voxels, int u_axis, int v_axis, int w_axis);
  // The same, and appends each voxel to `firsts` where it is met first.
  void assign(std::span<const Voxel> voxels, int u_axis, int v_axis, int w_axis, std::vector<Voxel>& firsts);

  // In ascending order of (v, u, w). A column with a gap ends a row, and the next begins with the same
  // column.
  void emit(RowSink& sink);

 private:
  struct Line {  // the columns of one v
    std::int32_t first = 0;
    std::int32_t last = -1;
    std::int64_t cells = 0;  // place of the first one's cell
  };
  struct Cell {
    std::int32_t base = 0;  // w of bit 0
    std::uint32_t members = 0;
  };
  void make_lines(std::span<const Voxel> voxels);
  bool add(const Voxel& voxel);

  std::size_t u_ = 2;
  std::size_t v_ = 1;
  std::size_t w_ = 0;
  std::int32_t v0_ = 0;
  std::vector<Line> lines_;
  std::vector<Cell> cells_;
  std::vector<std::int32_t> lo_;
  std::vector<std::int32_t> hi_;
};

}  // namespace footwall::voxelize::detail
