#include "engine/extract/exchange/wanted_voxels.h"

#include <algorithm>
#include <optional>

#include "engine/extract/parallel_faces.h"
#include "engine/voxelize/exact.h"
#include "engine/voxelize/registry.h"

namespace footwall::extract {
namespace {

// Inlines and crosslines only: a voxel's neighbours are at the same sample.
survey::Box reaching(const survey::Box& box, std::int64_t reach, const survey::Index& dims) {
  return survey::intersection(
      {{box.lo[0] - reach, box.lo[1] - reach, box.lo[2]}, {box.hi[0] + reach, box.hi[1] + reach, box.hi[2]}},
      {{0, 0, 0}, dims});
}

class ToSet final : public voxelize::RowSink {
 public:
  explicit ToSet(VoxelSet& set) : set_(set) {}
  void row(const voxelize::Row& row) override { set_.add(row); }

 private:
  VoxelSet& set_;
};

// One set for each rank, made when first used.
class SetPerRank {
 public:
  SetPerRank(const survey::Box& part, int ranks) : part_(part), sets_(static_cast<std::size_t>(ranks)) {}
  VoxelSet& of(int rank) {
    std::optional<VoxelSet>& set = sets_[static_cast<std::size_t>(rank)];
    if (!set) set.emplace(part_);
    return *set;
  }
  bool has(std::size_t rank) const { return sets_[rank].has_value(); }
  void release(std::size_t rank) { sets_[rank].reset(); }

 private:
  survey::Box part_;
  std::vector<std::optional<VoxelSet>> sets_;
};

// Own voxels for each receiver, collected by `visit(thread's voxelizer, place of a face, box of own, set)`
// for each face of another rank that comes near one of the own boxes.
template <typename Visit>
ListPerRank own_voxels_for_others(const Setup& setup, bool grows, Visit&& visit) {
  const auto ranks = static_cast<std::size_t>(setup.world.size());
  ListPerRank lists(ranks);
  if (ranks == 1 || setup.blocks.empty()) return lists;
  const std::int64_t reach = setup.reach();
  const survey::Box part = reaching(part_of(setup.grid, setup.world.rank()), reach, setup.input.dims);
  std::vector<survey::Box> boxes;
  for (const Block& block : setup.blocks.all()) {
    boxes.push_back(reaching(block.own(), reach, setup.input.dims));
  }

  std::vector<SetPerRank> sets;  // of each thread
  for (int thread = 0; thread < setup.threads; ++thread) sets.emplace_back(part, setup.world.size());
  parallel_faces(setup.input.faces.size(), setup.threads, setup.job, "voxelize",
                 [&](std::size_t thread, std::size_t n) {
                   if (setup.mine(n)) return;
                   const survey::Box around = voxelize::bounding_voxels(setup.face(n).triangle);
                   for (const survey::Box& box : boxes) {
                     const survey::Box both = survey::intersection(around, box);
                     if (!both.empty()) visit(thread, n, both, sets[thread].of(setup.responsible[n]));
                   }
                 });

  std::optional<VoxelSet> room;
  for (std::size_t r = 0; r < ranks; ++r) {
    const auto receiver = static_cast<int>(r);
    VoxelSet* all = nullptr;
    for (SetPerRank& each : sets) {
      if (!each.has(r)) continue;
      if (all == nullptr) {
        all = &each.of(receiver);
      } else {
        all->add(each.of(receiver));
      }
    }
    if (all == nullptr) continue;
    if (grows && reach > 0) {
      if (!room) room.emplace(part);
      grow(*all, setup.reach(), *room);
    }
    const BrickOwners& owners = setup.cache.owners();
    all->for_each([&](const BrickMask& brick) {
      const Mask mask = without(brick.mask & owners.owned(setup.world.rank(), brick.brick),
                                owners.held(receiver, brick.brick));
      if (!none(mask)) lists[r].push_back({brick.brick, mask});
    });
    for (SetPerRank& each : sets) each.release(r);
  }
  return lists;
}

// Takes the rows of a face that a block of this rank does not hold with all their neighbours.
class ToSetUnlessHeld final : public voxelize::RowSink {
 public:
  ToSetUnlessHeld(VoxelSet& set, std::span<const survey::Box> held) : set_(set), held_(held) {}
  void row(const voxelize::Row& row) override {
    survey::Index first{};
    first[static_cast<std::size_t>(row.v_axis)] = row.v;
    survey::Index last = first;
    first[static_cast<std::size_t>(row.u_axis)] = row.u0;
    last[static_cast<std::size_t>(row.u_axis)] = row.u0 + static_cast<std::int64_t>(row.lo.size()) - 1;
    first[static_cast<std::size_t>(row.w_axis)] = *std::min_element(row.lo.begin(), row.lo.end());
    last[static_cast<std::size_t>(row.w_axis)] = *std::max_element(row.hi.begin(), row.hi.end());
    for (const survey::Box& box : held_) {
      if (box.contains(first) && box.contains(last)) return;
    }
    set_.add(row);
  }

 private:
  VoxelSet& set_;
  std::span<const survey::Box> held_;
};

}  // namespace

ListPerRank needed_from(const Setup& setup, std::span<const std::size_t> faces) {
  ListPerRank lists(static_cast<std::size_t>(setup.world.size()));
  if (faces.empty() || setup.world.size() == 1) return lists;
  const survey::Box survey{{0, 0, 0}, setup.input.dims};
  std::vector<survey::Box> held;
  for (const Block& block : setup.blocks.all())
    held.push_back(setup.reach() > 0 ? block.own() : block.wanted());

  struct Worker {
    std::unique_ptr<voxelize::Voxelizer> voxelizer;
    VoxelSet set;
  };
  std::vector<Worker> workers(std::min(static_cast<std::size_t>(setup.threads), faces.size()));
  for (Worker& worker : workers) {
    worker.voxelizer = voxelize::make_voxelizer(setup.options.voxelizer);
    worker.set = VoxelSet(survey);
  }
  parallel_faces(faces.size(), static_cast<int>(workers.size()), setup.job, "voxelize",
                 [&](std::size_t thread, std::size_t n) {
                   ToSetUnlessHeld sink(workers[thread].set, held);
                   workers[thread].voxelizer->rows(setup.face(faces[n]).triangle, survey, sink);
                 });
  VoxelSet& all = workers.front().set;
  for (std::size_t n = 1; n < workers.size(); ++n) all.add(workers[n].set);
  if (setup.reach() > 0) {
    VoxelSet room(survey);
    grow(all, setup.reach(), room);
  }
  const BrickOwners& owners = setup.cache.owners();
  all.for_each([&](const BrickMask& brick) {
    const Mask lacking = without(brick.mask, owners.held(setup.world.rank(), brick.brick));
    if (none(lacking)) return;
    owners.for_each_owner(brick.brick, [&](int owner, const MaskProduct& owned) {
      const Mask part = lacking & owned;
      if (!none(part)) lists[static_cast<std::size_t>(owner)].push_back({brick.brick, part});
    });
  });
  return lists;
}

ListPerRank needed_by(const Setup& setup) {
  std::vector<std::unique_ptr<voxelize::Voxelizer>> voxelizers(static_cast<std::size_t>(setup.threads));
  for (auto& voxelizer : voxelizers) voxelizer = voxelize::make_voxelizer(setup.options.voxelizer);
  return own_voxels_for_others(setup, true,
                               [&](std::size_t thread, std::size_t n, const survey::Box& box, VoxelSet& set) {
                                 ToSet sink(set);
                                 voxelizers[thread]->rows(setup.face(n).triangle, box, sink);
                               });
}

ListPerRank around_faces_of(const Setup& setup) {
  return own_voxels_for_others(
      setup, false, [&](std::size_t, std::size_t n, const survey::Box&, VoxelSet& set) {
        set.add(reaching(voxelize::bounding_voxels(setup.face(n).triangle), setup.reach(), setup.input.dims));
      });
}

void leave_out_cached(const Setup& setup, ListPerRank& needed) {
  for (std::size_t r = 0; r < needed.size(); ++r) {
    if (!needed[r].empty()) needed[r] = setup.cache.missing(static_cast<int>(r), needed[r]);
  }
}

void leave_out_sent(const Setup& setup, ListPerRank& wanted) {
  for (std::size_t r = 0; r < wanted.size(); ++r) {
    if (!wanted[r].empty()) wanted[r] = setup.sent.missing(static_cast<int>(r), wanted[r]);
  }
}

void widen_to_blocks(const Setup& setup, std::int64_t side, ListPerRank& needed) {
  if (side <= 1) return;
  const BrickOwners& owners = setup.cache.owners();
  for (std::size_t r = 0; r < needed.size(); ++r) {
    if (needed[r].empty()) continue;
    const survey::Box part = part_of(setup.grid, static_cast<int>(r));
    VoxelSet set(part);
    VoxelSet room(part);
    set.add(needed[r]);
    add_blocks(set, side, room);
    needed[r].clear();
    set.for_each([&](const BrickMask& brick) {
      const Mask mask = without(brick.mask & owners.owned(static_cast<int>(r), brick.brick),
                                owners.held(setup.world.rank(), brick.brick));
      if (!none(mask)) needed[r].push_back({brick.brick, mask});
    });
  }
}

}  // namespace footwall::extract
