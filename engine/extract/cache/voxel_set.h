// A sparse set of voxels of a part of the survey: a directory over the bricks of the part, of which only the
// touched pages take memory, and a mask of 64 bytes for every brick that holds a voxel.
#pragma once
#include <cstdlib>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "engine/extract/cache/brick.h"
#include "engine/extract/cache/row_tiles.h"
#include "engine/voxelize/rows.h"

namespace footwall::extract {

class VoxelSet {
 public:
  // The empty set of nothing: holds no voxel and takes none.
  VoxelSet() = default;
  // A set of voxels of `part`; empty at first. Throws std::bad_alloc, as all that adds does.
  explicit VoxelSet(const survey::Box& part);
  VoxelSet(VoxelSet&&) noexcept = default;
  VoxelSet& operator=(VoxelSet&&) noexcept = default;

  const survey::Box& part() const { return box_.voxels(); }
  bool empty() const { return places_.empty(); }
  std::int64_t count() const;                                                        // voxels; O(bricks)
  std::int64_t bricks() const { return static_cast<std::int64_t>(places_.size()); }  // that hold a voxel

  // Every voxel of the row, which must lie in part().
  void add(const voxelize::Row& row);
  // The voxels of a box, of a list or of another set that lie in part().
  void add(const survey::Box& box);
  void add(const BrickMask& brick);
  void add(const BrickList& list);
  void add(const VoxelSet& other);
  // The same, each moved by `by` voxels along an axis; what leaves part() is dropped.
  void add_shifted(const VoxelSet& other, int axis, std::int64_t by);
  void remove(const VoxelSet& other);
  // Takes all voxels of a brick out.
  void drop(const survey::Index& brick);

  bool contains(const survey::Index& voxel) const;
  // The voxels in a brick; none for one outside part().
  const Mask& in(const survey::Index& brick) const;
  // The number, below bricks(), under which the brick is kept; -1 where it holds no voxel. drop() gives the
  // dropped brick's number to the one with the highest.
  std::int64_t slot(const survey::Index& brick) const;
  survey::Index brick_of(std::int64_t slot) const {
    return box_.brick(places_[static_cast<std::size_t>(slot)]);
  }

  // visit(const BrickMask&) for every brick with a voxel, in ascending order.
  template <typename Visit>
  void for_each(Visit&& visit) const;
  BrickList list() const;

  // Empties it and keeps the memory, so that filling it again allocates nothing.
  void clear();

 private:
  struct Release {
    void operator()(void* memory) const { std::free(memory); }
  };
  template <typename T>
  using Zeros = std::unique_ptr<T[], Release>;

  Mask& mask_at(std::int64_t place);

  BrickBox box_;
  Zeros<std::uint32_t> directory_;                                  // by place: 1 + slot; 0 = no voxel
  Zeros<std::uint64_t> occupied_;                                   // a bit for each place
  std::vector<std::int64_t> places_;                                // by slot
  std::vector<Mask> masks_;                                         // by slot; none of them empty
  std::vector<RowTile> tiles_;                                      // of the row that is added
  std::int64_t lowest_ = std::numeric_limits<std::int64_t>::max();  // words of occupied_ that may not be 0
  std::int64_t highest_ = -1;
};

// Adds to every voxel of the set those up to `reach` traces away in inline and in crossline direction, inside
// its part. `room` is to work in, of the same part.
void grow(VoxelSet& set, std::int32_t reach, VoxelSet& room);
// Adds around every voxel x the block of side^3 voxels that begins at x - floor(side / 2) on each axis,
// inside its part.
void add_blocks(VoxelSet& set, std::int64_t side, VoxelSet& room);

template <typename Visit>
void VoxelSet::for_each(Visit&& visit) const {
  for (std::int64_t w = lowest_; w <= highest_; ++w) {
    for (std::uint64_t word = occupied_[static_cast<std::size_t>(w)]; word != 0; word &= word - 1) {
      const std::int64_t place = w * 64 + std::countr_zero(word);
      const Mask& mask = masks_[directory_[static_cast<std::size_t>(place)] - 1];
      const survey::Index brick = box_.brick(place);
      visit(BrickMask{{static_cast<std::int32_t>(brick[0]), static_cast<std::int32_t>(brick[1]),
                       static_cast<std::int32_t>(brick[2])},
                      mask});
    }
  }
}

}  // namespace footwall::extract
