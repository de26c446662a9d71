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
  // `cells`: of the volume, inside the field and counted as its own; blocks begin at the cells' first one and
  // end with them. A block counts if its samples are neither all below the isovalue nor all at or above it;
  // nulls are neither.
  std::int64_t of(const Field& field, const survey::Box& cells, float isovalue, const survey::Index& block);

 private:
  std::vector<std::uint8_t> signs_;  // per sample: 1 below, 2 at or above the isovalue
  std::vector<std::uint8_t> met_;    // the same of a row of samples for rows of a block
};

}  // namespace footwall::isosurface
