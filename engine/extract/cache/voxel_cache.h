// The values of other ranks' voxels that this rank was sent, by bricks, kept from one extraction to the next;
// and the record of what this rank sent to others, from which it knows what they keep.
// Based on: seed 004, section 3.4; differs in that memory is in proportion to what was sent, at any rank
// count, has a limit, and that sender and receiver know of each other what is kept without asking.
//
// Every exchange strategy enters what it moves in both, on both sides, so that strategies may change from one
// extraction to the next. During an extraction nothing is dropped; after it `trim` keeps the limit, which is
// the same for every pair of ranks: a rank's cache_bytes divided by the number of other ranks.
#pragma once
#include <cstdlib>
#include <memory>
#include <span>
#include <vector>

#include "engine/extract/blocks.h"
#include "engine/extract/cache/brick_owners.h"
#include "engine/extract/cache/pair_ledger.h"

namespace footwall::extract {

// Bricks that a pair may keep between extractions.
std::int64_t bricks_of_a_pair(std::int64_t cache_bytes, int ranks);

// The smallest box around all voxels of a rank; empty for a rank without any.
survey::Box part_of(const comm::RankGrid& grid, int rank);

class VoxelCache {
 public:
  // `grid` and `blocks` must outlive it.
  VoxelCache(const comm::RankGrid& grid, const Blocks& blocks);
  VoxelCache(const VoxelCache&) = delete;
  VoxelCache& operator=(const VoxelCache&) = delete;

  const BrickOwners& owners() const { return owners_; }

  // What of `wanted`, voxels of `owner`, is not here.
  BrickList lacking(int owner, const BrickList& wanted) const;
  // The same; the rest counts as hits of this extraction.
  BrickList missing(int owner, const BrickList& wanted);
  // Takes the values of a list that `owner` sent, in the order of its bricks and bits.
  void put(int owner, const BrickList& list, std::span<const float> values);

  // The 512 values [inline][crossline][sample] of a brick; null where nothing of it was received. Only voxels
  // that were put, and those that this rank holds itself, have a value.
  const float* brick(const survey::Index& brick) const {
    const std::uint32_t slot = directory_[static_cast<std::size_t>(box_.place(brick))];
    return slot == 0 ? nullptr : values(slot - 1);
  }

  // The next extraction begins: its transfers are younger than all before. All ranks alike.
  void begin_extraction();
  // Keeps the limit; returns whether bricks of this very extraction had to go. All ranks alike.
  bool trim(std::int64_t cache_bytes);
  void clear();

  std::int64_t hits() const { return hits_; }  // voxels of this extraction that were here already
  std::int64_t voxels() const;                 // kept

 private:
  static constexpr std::size_t kChunk = 256;  // bricks that are allocated together
  float* values(std::size_t slot) const {
    return chunks_[slot / kChunk].get() + slot % kChunk * static_cast<std::size_t>(kBrickVoxels);
  }
  // Where a brick's values are to go, for one pair more or for those there are.
  float* slot_values(const survey::Index& brick, bool another_pair);
  void copy_own(const survey::Index& brick, float* values) const;

  struct Release {
    void operator()(void* memory) const { std::free(memory); }
  };

  const comm::RankGrid& grid_;
  const Blocks& blocks_;
  BrickOwners owners_;
  BrickBox box_;                                         // of the survey
  std::unique_ptr<std::uint32_t[], Release> directory_;  // by place: 1 + slot; 0 = none
  std::vector<std::unique_ptr<float[]>> chunks_;
  std::vector<std::uint32_t> pairs_;                  // of each slot: pairs that keep some of it
  std::vector<std::size_t> unused_;                   // slots
  std::vector<std::unique_ptr<PairLedger>> ledgers_;  // by owner; null where nothing was received
  std::int64_t time_ = 0;
  std::int64_t hits_ = 0;
};

class SentRecord {
 public:
  SentRecord(const comm::RankGrid& grid, int rank);

  // What of `wanted`, voxels of this rank, `receiver` does not have.
  BrickList missing(int receiver, const BrickList& wanted) const;
  void enter(int receiver, const BrickList& list);

  // As for VoxelCache.
  void begin_extraction();
  void trim(std::int64_t cache_bytes);
  void clear();

 private:
  int ranks_;
  survey::Box part_;
  std::vector<std::unique_ptr<PairLedger>> ledgers_;  // by receiver; null where nothing was sent
  std::int64_t time_ = 0;
};

}  // namespace footwall::extract
