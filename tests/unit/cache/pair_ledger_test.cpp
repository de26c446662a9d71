#include "engine/extract/cache/pair_ledger.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace footwall::extract {
namespace {

const survey::Box kPart{{0, 16, 0}, {64, 48, 40}};

BrickList some_bricks(std::mt19937_64& random) {
  VoxelSet set(kPart);
  for (int n = 0; n < 12; ++n) {
    const survey::Index p{static_cast<std::int64_t>(random() % 64),
                          16 + static_cast<std::int64_t>(random() % 32),
                          static_cast<std::int64_t>(random() % 40)};
    set.add(survey::Box{p, {p[0] + 3, p[1] + 2, p[2] + 4}});
  }
  return set.list();
}

// The rule, by hand: time and mask of every brick; the oldest go first, the lower index of two alike.
class Model {
 public:
  void enter(const BrickList& list, std::int64_t time) {
    for (const BrickMask& each : list) {
      auto& [last, mask] = bricks_[each.brick];
      last = time;
      for (std::size_t w = 0; w < 8; ++w) mask[w] |= each.mask[w];
    }
  }
  void keep(std::size_t most) {
    while (bricks_.size() > most) {
      auto oldest = bricks_.begin();
      for (auto at = bricks_.begin(); at != bricks_.end(); ++at) {
        if (at->second.first < oldest->second.first) oldest = at;
      }
      bricks_.erase(oldest);
    }
  }
  void expect_equal(const PairLedger& ledger) const {
    std::int64_t voxels = 0;
    for (const auto& [brick, entry] : bricks_) {
      EXPECT_EQ(ledger.in({brick[0], brick[1], brick[2]}), entry.second);
      voxels += voxels_in(entry.second);
    }
    EXPECT_EQ(ledger.bricks(), static_cast<std::int64_t>(bricks_.size()));
    EXPECT_EQ(ledger.voxels(), voxels);
  }

 private:
  std::map<std::array<std::int32_t, 3>, std::pair<std::int64_t, Mask>> bricks_;
};

TEST(PairLedger, KeepsTheYoungestBricks) {
  std::mt19937_64 random(1);
  PairLedger ledger(kPart);
  Model model;
  for (std::int64_t time = 1; time < 60; ++time) {
    const BrickList list = some_bricks(random);
    ledger.enter(list, time);
    model.enter(list, time);
    model.expect_equal(ledger);
    const std::size_t most = time % 10 == 0 ? 0 : random() % 60;
    const std::int64_t before = ledger.bricks();
    const auto gone = ledger.keep(static_cast<std::int64_t>(most));
    model.keep(most);
    model.expect_equal(ledger);
    EXPECT_EQ(static_cast<std::int64_t>(gone.size()), before - ledger.bricks());
  }
}

TEST(PairLedger, TellsWhatIsMissing) {
  std::mt19937_64 random(2);
  PairLedger ledger(kPart);
  const BrickList first = some_bricks(random);
  VoxelSet both(kPart);
  both.add(some_bricks(random));
  both.add(BrickList(first.begin(), first.begin() + 5));
  const BrickList second = both.list();
  EXPECT_EQ(voxels_in(ledger.missing(first)), voxels_in(first));
  ledger.enter(first, 1);
  EXPECT_TRUE(ledger.missing(first).empty());
  const BrickList missing = ledger.missing(second);
  EXPECT_LT(voxels_in(missing), voxels_in(second));
  ledger.enter(missing, 2);
  EXPECT_EQ(ledger.voxels(), voxels_in(first) + voxels_in(missing));
  EXPECT_TRUE(ledger.missing(second).empty());
}

}  // namespace
}  // namespace footwall::extract
