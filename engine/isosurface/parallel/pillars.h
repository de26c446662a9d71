// How the cells of a volume are dealt out to ranks, as plain arithmetic without MPI. Cells, not samples: a
// cell belongs to one pillar, and the samples between two pillars to both.
// Based on: seed 000, section 4. The volume is cut into nX CX x nY CY pillars for ranks in a grid of CX x CY;
// rank (i, j) gets the pillars (i + l CX, j + m CY). Pillars that are cut along samples, too (the seed's
// proposed improvement), are dealt out so that those above each other go to different ranks.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "storage/survey/box.h"

namespace footwall::isosurface {

// Pieces along inlines and along crosslines that each rank gets, and pieces along samples.
using Interleaving = std::array<int, 3>;

// "4x2" or "4x2x1". Throws Error kUsage for anything else, and for numbers outside 1 .. 1024.
Interleaving parse_interleaving(std::string_view text);
std::string text_of(const Interleaving& interleaving);  // "4x2x1"

struct Pillar {
  int rank = 0;
  survey::Box cells;  // never empty
};

class Pillars {
 public:
  // volume: samples. The rank grid is the one whose busiest rank has the fewest cells; ties go to the pillars
  // with the shortest border, then to fewer ranks along inlines. Pieces along an axis differ by at most one
  // cell; where there are more pieces than cells, some are empty. Throws kInternal for ranks < 1, an
  // interleaving < 1 or a volume without samples; a volume of one sample along an axis has no cells.
  Pillars(const survey::Index& volume, int ranks, const Interleaving& interleaving);

  const survey::Index& volume() const { return volume_; }
  int ranks() const { return grid_[0] * grid_[1]; }
  std::array<int, 2> grid() const { return grid_; }  // ranks along inlines and along crosslines
  const Interleaving& interleaving() const { return interleaving_; }
  int layers() const { return parts_[2]; }  // pieces along samples

  // Those of a rank that have cells, ascending by inline, crossline, sample.
  std::vector<survey::Box> of_rank(int rank) const;
  std::vector<Pillar> all() const;
  // The rank of a cell inside the volume. cell_of() a sample: the cell that begins there, the last one for
  // the samples at the volume's far faces.
  int owner(const survey::Index& cell) const;
  int rank_of(const std::array<int, 3>& part) const;  // of the pillar that is so many along each axis
  int layer(std::int64_t cell_k) const { return part_of(2, cell_k); }
  survey::Index cell_of(const survey::Index& sample) const;

  // The samples that cells need: theirs, and for central differences one more on each side, cut at the
  // volume.
  survey::Box samples_of(const survey::Box& cells, bool normals) const;
  // Samples that the ranks store together beyond those of the volume.
  std::int64_t overlap_samples(bool normals) const;

 private:
  int part_of(int axis, std::int64_t cell) const;
  std::int64_t first_of(int axis, std::int64_t part) const { return cells_[axis] * part / parts_[axis]; }

  survey::Index volume_;
  survey::Index cells_{0, 0, 0};
  Interleaving interleaving_;
  std::array<int, 2> grid_{1, 1};
  std::array<int, 3> parts_{1, 1, 1};
};

}  // namespace footwall::isosurface
