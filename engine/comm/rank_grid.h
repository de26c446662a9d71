// The Cartesian decomposition of a survey over ranks, as plain arithmetic without MPI: ranks form a grid over
// inlines and crosslines, and each owns full columns (every sample of its traces).
// Based on: seed 004, section 3.2. Where the counts do not divide, the survey is thought padded: every rank
// gets ceil(count / ranks) lines, so the last ones may own fewer, or none at all.
#pragma once
#include <array>

#include "storage/survey/box.h"

namespace footwall::comm {

class RankGrid {
 public:
  // The grid of `ranks` whose largest part has the fewest traces; ties go to the shorter border, then to
  // fewer ranks along inlines. Throws kInternal for ranks < 1 or an empty survey.
  RankGrid(const survey::Index& dims, int ranks);

  int ranks() const { return parts_[0] * parts_[1]; }
  // Ranks along inlines and along crosslines.
  std::array<int, 2> parts() const { return parts_; }
  const survey::Index& dims() const { return dims_; }
  // The voxels of a rank; empty for a rank that the padding leaves without any.
  survey::Box box(int rank) const;
  // The rank that owns a voxel inside the survey.
  int owner(const survey::Index& voxel) const {
    return static_cast<int>(voxel[0] / lines_[0]) * parts_[1] + static_cast<int>(voxel[1] / lines_[1]);
  }

 private:
  survey::Index dims_;
  std::array<int, 2> parts_{1, 1};
  std::array<std::int64_t, 2> lines_{1, 1};  // inlines and crosslines of each rank, padding included
};

}  // namespace footwall::comm
