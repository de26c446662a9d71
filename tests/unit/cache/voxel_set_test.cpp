#include "engine/extract/cache/voxel_set.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace footwall::extract {
namespace {

using Model = std::set<survey::Index>;  // ordered as masks are: inline, crossline, sample within a brick

const survey::Box kPart{{3, 13, 0}, {45, 38, 27}};

Model members(const VoxelSet& set) {
  Model model;
  std::array<std::int32_t, 3> last{-1, -1, -1};
  set.for_each([&](const BrickMask& each) {
    EXPECT_LT(last, each.brick) << "bricks must ascend";
    EXPECT_FALSE(none(each.mask));
    last = each.brick;
    for (std::int64_t i = 0; i < 8; ++i) {
      for (std::int64_t bit = 0; bit < 64; ++bit) {
        if ((each.mask[static_cast<std::size_t>(i)] >> bit & 1) == 0) continue;
        model.insert({each.brick[0] * 8 + i, each.brick[1] * 8 + bit / 8, each.brick[2] * 8 + bit % 8});
      }
    }
  });
  return model;
}

void expect_equal(const VoxelSet& set, const Model& model) {
  EXPECT_EQ(members(set), model);
  EXPECT_EQ(set.count(), static_cast<std::int64_t>(model.size()));
  EXPECT_EQ(set.empty(), model.empty());
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  std::int64_t below(std::int64_t n) {
    return static_cast<std::int64_t>(engine_() % static_cast<std::uint64_t>(n));
  }
  survey::Index voxel(const survey::Box& in) {
    return {in.lo[0] + below(in.size(0)), in.lo[1] + below(in.size(1)), in.lo[2] + below(in.size(2))};
  }
  survey::Box box(const survey::Box& in, std::int64_t most) {
    survey::Box box{voxel(in), {}};
    for (std::size_t axis = 0; axis < 3; ++axis) box.hi[axis] = box.lo[axis] + below(most);
    return box;
  }

 private:
  std::mt19937_64 engine_;
};

void insert(const survey::Box& box, const survey::Box& part, Model& model) {
  const survey::Box both = survey::intersection(box, part);
  for (std::int64_t i = both.lo[0]; i < both.hi[0]; ++i) {
    for (std::int64_t j = both.lo[1]; j < both.hi[1]; ++j) {
      for (std::int64_t k = both.lo[2]; k < both.hi[2]; ++k) model.insert({i, j, k});
    }
  }
}

TEST(VoxelSet, TakesRowsOfAllAxesWithEmptyAndLongColumns) {
  Random random(1);
  for (const std::array<int, 3> axes : {std::array{0, 1, 2}, std::array{0, 2, 1}, std::array{1, 0, 2},
                                        std::array{1, 2, 0}, std::array{2, 0, 1}, std::array{2, 1, 0}}) {
    VoxelSet set(kPart);
    Model model;
    for (int n = 0; n < 60; ++n) {
      const auto [u, v, w] = axes;
      const survey::Index first = random.voxel(kPart);
      std::vector<std::int32_t> lo;
      std::vector<std::int32_t> hi;
      survey::Index voxel = first;
      for (std::int64_t at = first[static_cast<std::size_t>(u)];
           at < kPart.hi[static_cast<std::size_t>(u)] && lo.size() < 20; ++at) {
        lo.push_back(
            static_cast<std::int32_t>(kPart.lo[static_cast<std::size_t>(w)] + random.below(kPart.size(w))));
        const std::int64_t length = random.below(5) == 0 ? random.below(30) : random.below(4);
        hi.push_back(static_cast<std::int32_t>(
            std::min(lo.back() - 1 + length, kPart.hi[static_cast<std::size_t>(w)] - 1)));
        voxel[static_cast<std::size_t>(u)] = at;
        for (std::int32_t k = lo.back(); k <= hi.back(); ++k) {
          voxel[static_cast<std::size_t>(w)] = k;
          model.insert(voxel);
        }
      }
      set.add(voxelize::Row{u, v, w, first[static_cast<std::size_t>(u)], first[static_cast<std::size_t>(v)],
                            lo, hi});
    }
    expect_equal(set, model);
    for (int n = 0; n < 200; ++n) {
      const survey::Index voxel = random.voxel(survey::grown(kPart, 9));
      EXPECT_EQ(set.contains(voxel), model.contains(voxel));
    }
  }
}

TEST(VoxelSet, TakesBoxesAndLeavesOutWhatIsBeyondItsPart) {
  Random random(2);
  for (int round = 0; round < 20; ++round) {
    VoxelSet set(kPart);
    Model model;
    for (int n = 0; n < 5; ++n) {
      const survey::Box box = random.box(survey::grown(kPart, 10), 25);
      set.add(box);
      insert(box, kPart, model);
    }
    expect_equal(set, model);
  }
}

TEST(VoxelSet, MovesAlongEveryAxis) {
  Random random(3);
  for (int round = 0; round < 40; ++round) {
    const survey::Box other_part = survey::grown(kPart, random.below(20) - 8);
    VoxelSet from(other_part);
    Model model;
    for (int n = 0; n < 10; ++n) {
      const survey::Box box = random.box(other_part, 4);
      from.add(box);
      insert(box, other_part, model);
    }
    const auto axis = static_cast<int>(random.below(3));
    const std::int64_t by = random.below(41) - 20;
    VoxelSet to(kPart);
    to.add_shifted(from, axis, by);
    Model moved;
    for (survey::Index voxel : model) {
      voxel[static_cast<std::size_t>(axis)] += by;
      if (kPart.contains(voxel)) moved.insert(voxel);
    }
    expect_equal(to, moved);
  }
}

TEST(VoxelSet, GrowsByTracesAndByBlocks) {
  Random random(4);
  VoxelSet room(kPart);
  for (const std::int64_t side : {1, 2, 3, 8, 13}) {
    VoxelSet set(kPart);
    Model seeds;
    for (int n = 0; n < 12; ++n) seeds.insert(random.voxel(kPart));
    seeds.insert(kPart.lo);
    seeds.insert({kPart.hi[0] - 1, kPart.hi[1] - 1, kPart.hi[2] - 1});
    Model grown;
    Model blocks;
    for (const survey::Index& p : seeds) {
      set.add(survey::Box{p, {p[0] + 1, p[1] + 1, p[2] + 1}});
      insert({{p[0] - 2, p[1] - 2, p[2]}, {p[0] + 3, p[1] + 3, p[2] + 1}}, kPart, grown);
      const std::int64_t before = side / 2;
      insert({{p[0] - before, p[1] - before, p[2] - before},
              {p[0] - before + side, p[1] - before + side, p[2] - before + side}},
             kPart, blocks);
    }
    VoxelSet by_traces(kPart);
    by_traces.add(set);
    grow(by_traces, 2, room);
    expect_equal(by_traces, grown);
    add_blocks(set, side, room);
    expect_equal(set, blocks);
  }
}

TEST(VoxelSet, RemovesDropsAndStartsAnew) {
  Random random(5);
  VoxelSet set(kPart);
  for (int round = 0; round < 10; ++round) {
    Model model;
    VoxelSet other(survey::grown(kPart, -3));
    Model gone;
    for (int n = 0; n < 8; ++n) {
      const survey::Box box = random.box(kPart, 12);
      set.add(box);
      insert(box, kPart, model);
      const survey::Box hole = random.box(kPart, 12);
      other.add(hole);
      insert(hole, other.part(), gone);
    }
    set.remove(other);
    for (const survey::Index& voxel : gone) model.erase(voxel);
    expect_equal(set, model);
    if (!model.empty()) {
      const survey::Index p = *model.begin();
      const survey::Index brick{p[0] >> 3, p[1] >> 3, p[2] >> 3};
      set.drop(brick);
      std::erase_if(model, [&](const survey::Index& voxel) {
        return voxel[0] >> 3 == brick[0] && voxel[1] >> 3 == brick[1] && voxel[2] >> 3 == brick[2];
      });
      expect_equal(set, model);
      for (std::int64_t slot = 0; slot < set.bricks(); ++slot) EXPECT_EQ(set.slot(set.brick_of(slot)), slot);
    }
    set.clear();
    expect_equal(set, {});
  }
}

TEST(VoxelSet, OfNothingHoldsNothing) {
  VoxelSet set;
  set.add(survey::Box{{0, 0, 0}, {5, 5, 5}});
  expect_equal(set, {});
  EXPECT_FALSE(set.contains({0, 0, 0}));
}

}  // namespace
}  // namespace footwall::extract
