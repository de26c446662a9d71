// A volume in the memory of several ranks, cut between bricks: each rank has pillars of bricks with the
// samples around them.
// Based on: seed 000, section 4 (interleaved pillars); differs in that the cuts lie between bricks of 8 x 8 x
// 8 cells, so that what is known of a brick is known of one rank's.
#pragma once
#include <deque>
#include <span>
#include <vector>

#include "engine/isosurface/page_vector.h"
#include "engine/isosurface/parallel/extract_parallel.h"
#include "engine/isosurface/parallel/pillars.h"
#include "engine/isosurface/visible/visible_drawing.h"

namespace footwall::isosurface {

// Fine enough that every rank has some of whatever is seen: little has to move then, and what is not foreseen
// of the work is much the same on all.
inline constexpr Interleaving kVisibleInterleaving{8, 8, 1};

// The boxes of bricks of one rank; volume: samples.
std::vector<survey::Box> bricks_of_rank(const survey::Index& volume, int ranks, int rank,
                                        const Interleaving& interleaving);
// The samples that a box of bricks needs, with those around.
survey::Box samples_of_bricks(const survey::Box& bricks, const survey::Index& volume);

class BrickPillars {
 public:
  // Parts of a volume that is in memory anyway, and stays; nothing is copied.
  BrickPillars(const Field& volume, int ranks, int rank, const Interleaving& interleaving);
  // Reads this rank's share of a volume of so many samples and keeps it. Holds no communication; throws what
  // field_of throws, kMemory.
  BrickPillars(const FieldOf& field_of, const survey::Index& volume, int ranks, int rank,
               const Interleaving& interleaving);
  BrickPillars(const BrickPillars&) = delete;
  BrickPillars& operator=(const BrickPillars&) = delete;

  std::span<const VolumePart> parts() const { return parts_; }
  // Of the samples that it keeps.
  std::int64_t memory_bytes() const;

 private:
  std::deque<PageVector<float>> values_;
  std::vector<VolumePart> parts_;
};

}  // namespace footwall::isosurface
