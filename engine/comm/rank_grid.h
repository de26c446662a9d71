// The Cartesian decomposition of a survey over ranks, as plain arithmetic without MPI: ranks form a grid over
// inlines and crosslines, and each owns full columns (every sample of its traces).
// Based on: seed 004, section 3.2. Where the counts do not divide, the survey is thought padded: every pillar
// gets ceil(count / pillars) lines, so the last ones may hold fewer, or none at all.
// Interleaved (seed 000): the survey is cut into `pillars` times as many pieces along an axis as there are
// ranks along it, dealt out in turn, so that a crowded corner of the survey is shared by many ranks.
#pragma once
#include <array>
#include <vector>

#include "storage/survey/box.h"

namespace footwall::comm {

class RankGrid {
 public:
  // The grid of `ranks` whose largest part has the fewest traces; ties go to the shorter border, then to
  // fewer ranks along inlines. pillars: how many a rank has along inlines and along crosslines, 1 x 1 for a
  // plain decomposition. Throws kInternal for ranks < 1, pillars < 1 or an empty survey.
  RankGrid(const survey::Index& dims, int ranks, std::array<int, 2> pillars = {1, 1});

  int ranks() const { return parts_[0] * parts_[1]; }
  // Ranks along inlines and along crosslines.
  std::array<int, 2> parts() const { return parts_; }
  // Pillars of a rank along inlines and along crosslines.
  std::array<int, 2> pillars() const { return pillars_; }
  // Inlines and crosslines of each pillar, padding included.
  std::array<std::int64_t, 2> lines() const { return lines_; }
  const survey::Index& dims() const { return dims_; }
  // The voxels of a rank: disjoint boxes, none of them empty, ascending; none at all for a rank that the
  // padding leaves without any.
  std::vector<survey::Box> boxes(int rank) const;
  // The one box of a rank in a plain decomposition; may be empty.
  survey::Box box(int rank) const;
  // The rank that owns a voxel inside the survey.
  int owner(const survey::Index& voxel) const {
    return static_cast<int>(voxel[0] / lines_[0]) % parts_[0] * parts_[1] +
           static_cast<int>(voxel[1] / lines_[1]) % parts_[1];
  }
  // Rank coordinates (seed 004, section 4.3.3): along inlines and along crosslines, from 0.
  std::array<int, 2> place(int rank) const { return {rank / parts_[1], rank % parts_[1]}; }
  // Manhattan distance of two ranks' coordinates.
  int distance(int one, int other) const;

 private:
  survey::Index dims_;
  std::array<int, 2> parts_{1, 1};
  std::array<int, 2> pillars_{1, 1};
  std::array<std::int64_t, 2> lines_{1, 1};
};

}  // namespace footwall::comm
