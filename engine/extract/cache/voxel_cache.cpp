#include "engine/extract/cache/voxel_cache.h"

#include <algorithm>
#include <new>

#include "storage/base/error.h"

namespace footwall::extract {

std::int64_t bricks_of_a_pair(std::int64_t cache_bytes, int ranks) {
  return std::max<std::int64_t>(cache_bytes, 0) / std::max(ranks - 1, 1) / kBytesPerBrick;
}

survey::Box part_of(const comm::RankGrid& grid, int rank) {
  survey::Box part;
  for (const survey::Box& box : grid.boxes(rank)) {
    if (part.empty()) part = box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      part.lo[axis] = std::min(part.lo[axis], box.lo[axis]);
      part.hi[axis] = std::max(part.hi[axis], box.hi[axis]);
    }
  }
  return part;
}

VoxelCache::VoxelCache(const comm::RankGrid& grid, const Blocks& blocks)
    : grid_(grid),
      blocks_(blocks),
      owners_(grid),
      box_({{0, 0, 0}, grid.dims()}),
      directory_(static_cast<std::uint32_t*>(
          std::calloc(static_cast<std::size_t>(box_.count()), sizeof(std::uint32_t)))),
      ledgers_(static_cast<std::size_t>(grid.ranks())) {
  if (!directory_) throw std::bad_alloc();
}

BrickList VoxelCache::lacking(int owner, const BrickList& wanted) const {
  const auto& ledger = ledgers_.at(static_cast<std::size_t>(owner));
  return ledger ? ledger->missing(wanted) : wanted;
}

BrickList VoxelCache::missing(int owner, const BrickList& wanted) {
  BrickList rest = lacking(owner, wanted);
  hits_ += voxels_in(wanted) - voxels_in(rest);
  return rest;
}

void VoxelCache::put(int owner, const BrickList& list, std::span<const float> values) {
  auto& ledger = ledgers_.at(static_cast<std::size_t>(owner));
  if (!ledger) ledger = std::make_unique<PairLedger>(part_of(grid_, owner));
  const float* from = values.data();
  for (const BrickMask& each : list) {
    const survey::Index brick{each.brick[0], each.brick[1], each.brick[2]};
    const bool known = !none(ledger->in(brick));
    float* into = slot_values(brick, !known);
    for (std::size_t i = 0; i < each.mask.size(); ++i, into += 64) {
      for (std::uint64_t word = each.mask[i]; word != 0; word &= word - 1)
        into[std::countr_zero(word)] = *from++;
    }
  }
  require(from == values.data() + values.size(), "a value for every voxel of the list");
  ledger->enter(list, time_);
}

float* VoxelCache::slot_values(const survey::Index& brick, bool another_pair) {
  std::uint32_t& slot = directory_[static_cast<std::size_t>(box_.place(brick))];
  if (slot == 0) {
    if (unused_.empty()) {
      chunks_.push_back(
          std::make_unique_for_overwrite<float[]>(kChunk * static_cast<std::size_t>(kBrickVoxels)));
      pairs_.resize(chunks_.size() * kChunk);
      for (std::size_t n = kChunk; n-- > 0;) unused_.push_back((chunks_.size() - 1) * kChunk + n);
    }
    slot = static_cast<std::uint32_t>(unused_.back() + 1);
    unused_.pop_back();
    copy_own(brick, values(slot - 1));
  }
  if (another_pair) ++pairs_[slot - 1];
  return values(slot - 1);
}

void VoxelCache::copy_own(const survey::Index& brick, float* values) const {
  const survey::Index first{brick[0] * 8, brick[1] * 8, brick[2] * 8};
  const survey::Box box{first, {first[0] + 8, first[1] + 8, first[2] + 8}};
  for (const Block& block : blocks_.all()) {
    const survey::Box both = survey::intersection(box, block.wanted());
    if (both.empty()) continue;
    for (std::int64_t i = both.lo[0]; i < both.hi[0]; ++i) {
      for (std::int64_t j = both.lo[1]; j < both.hi[1]; ++j) {
        std::copy_n(block.data() + block.offset({i, j, both.lo[2]}), both.size(2),
                    values + (i & 7) * 64 + (j & 7) * 8 + (both.lo[2] & 7));
      }
    }
  }
}

void VoxelCache::begin_extraction() {
  ++time_;
  hits_ = 0;
}

bool VoxelCache::trim(std::int64_t cache_bytes) {
  bool of_this_extraction = false;
  const std::int64_t most = bricks_of_a_pair(cache_bytes, grid_.ranks());
  for (const auto& ledger : ledgers_) {
    if (!ledger) continue;
    for (const PairLedger::Gone& gone : ledger->keep(most)) {
      of_this_extraction |= gone.time == time_;
      std::uint32_t& slot = directory_[static_cast<std::size_t>(box_.place(gone.brick))];
      if (--pairs_[slot - 1] > 0) continue;
      unused_.push_back(slot - 1);
      slot = 0;
    }
  }
  return of_this_extraction;
}

void VoxelCache::clear() {
  trim(0);
  for (auto& ledger : ledgers_) ledger.reset();
  chunks_.clear();
  pairs_.clear();
  unused_.clear();
  hits_ = 0;
}

std::int64_t VoxelCache::voxels() const {
  std::int64_t sum = 0;
  for (const auto& ledger : ledgers_) sum += ledger ? ledger->voxels() : 0;
  return sum;
}

SentRecord::SentRecord(const comm::RankGrid& grid, int rank)
    : ranks_(grid.ranks()), part_(part_of(grid, rank)), ledgers_(static_cast<std::size_t>(grid.ranks())) {}

BrickList SentRecord::missing(int receiver, const BrickList& wanted) const {
  const auto& ledger = ledgers_.at(static_cast<std::size_t>(receiver));
  return ledger ? ledger->missing(wanted) : wanted;
}

void SentRecord::enter(int receiver, const BrickList& list) {
  if (list.empty()) return;
  auto& ledger = ledgers_.at(static_cast<std::size_t>(receiver));
  if (!ledger) ledger = std::make_unique<PairLedger>(part_);
  ledger->enter(list, time_);
}

void SentRecord::begin_extraction() {
  ++time_;
}

void SentRecord::trim(std::int64_t cache_bytes) {
  const std::int64_t most = bricks_of_a_pair(cache_bytes, ranks_);
  for (const auto& ledger : ledgers_) {
    if (ledger) ledger->keep(most);
  }
}

void SentRecord::clear() {
  for (auto& ledger : ledgers_) ledger.reset();
}

}  // namespace footwall::extract
