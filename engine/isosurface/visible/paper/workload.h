// How much work a cell of the octree will be, told from its samples before anything is extracted.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/isosurface/field.h"

namespace footwall::isosurface {

// Counts the smaller blocks in which the isovalue may be met. Keeps its room.
// Based on: seed 003, section 3.3; differs in that it asks the samples, and only those of visible cells,
// where the paper goes down some more levels of the octree for all active ones: the counts are the same where
// the blocks' size is the cells' divided by a power of two.
class Workload {
 public:
  // Of a block along each axis.
  static constexpr std::int64_t kMostCells = 32;

  // `cells`: of the volume, inside the field and counted as its own; blocks begin at the cells' first one and
  // end with them. A block counts if its samples are neither all below the isovalue nor all at or above it;
  // nulls are neither. Throws Error kUsage for blocks of less than 1 or more than kMostCells cells.
  std::int64_t of(const Field& field, const survey::Box& cells, float isovalue, const survey::Index& block);

  // Which samples of a row of at most 64 are below the isovalue, and which at or above it.
  struct Sides {
    std::uint64_t below = 0;
    std::uint64_t above = 0;
  };

 private:
  std::int64_t of_stretch(const survey::Box& cells, const survey::Index& block);

  std::vector<Sides> rows_;  // of samples, [i][j]
};

}  // namespace footwall::isosurface
