#include "engine/extract/replay/replay.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "engine/extract/balance/balance.h"
#include "engine/verify/voxel_oracle.h"
#include "engine/voxelize/exact.h"
#include "storage/base/error.h"
#include "unit/balance/random_faces.h"

namespace footwall::extract {
namespace {

using Voxels = std::set<survey::Index>;
using ByPair = std::map<std::pair<int, int>, Voxels>;  // owner, receiver

struct Case {
  survey::Index dims;
  comm::RankGrid grid;
  std::vector<Face> faces;
  std::vector<int> responsible;
  survey::Box survey() const { return {{0, 0, 0}, dims}; }
};

Case random_case(std::mt19937_64& random) {
  const survey::Index dims{9 + static_cast<std::int64_t>(random() % 30), 17, 70};
  const std::array<int, 2> pillars{1 + static_cast<int>(random() % 2), 1 + static_cast<int>(random() % 3)};
  Case made{dims, comm::RankGrid(dims, 1 + static_cast<int>(random() % 8), pillars), {}, {}};
  made.faces = random_faces(dims, 30, random);
  for (std::size_t n = 0; n < made.faces.size(); ++n) {
    made.responsible.push_back(static_cast<int>(random() % static_cast<unsigned>(made.grid.ranks())));
  }
  return made;
}

bool held(const comm::RankGrid& grid, int rank, const survey::Index& p) {
  const std::vector<survey::Box> boxes = grid.boxes(rank);
  return std::any_of(boxes.begin(), boxes.end(),
                     [&](const survey::Box& box) { return survey::grown(box, 1).contains(p); });
}

// What the strategies have to send, voxel by voxel: `wanted` gives the voxels of a face.
template <class Wanted>
ByPair missing(const Case& c, Wanted wanted) {
  ByPair sets;
  for (std::size_t n = 0; n < c.faces.size(); ++n) {
    for (const survey::Index& p : wanted(c.faces[n])) {
      const int to = c.responsible[n];
      if (c.survey().contains(p) && !held(c.grid, to, p)) sets[{c.grid.owner(p), to}].insert(p);
    }
  }
  return sets;
}

std::vector<survey::Index> looked_at(const Case& c, const Face& face, int reach) {
  voxelize::ExactScratch scratch;
  std::vector<survey::Index> all;
  for (const survey::Index& p : voxelize::list(face.triangle, c.survey(), scratch)) {
    for (std::int64_t i = -reach; i <= reach; ++i) {
      for (std::int64_t j = -reach; j <= reach; ++j) all.push_back({p[0] + i, p[1] + j, p[2]});
    }
  }
  return all;
}

std::vector<survey::Index> bounding(const Case& c, const Face& face, int reach) {
  const survey::Box box = survey::intersection(voxelize::bounding_voxels(face.triangle), c.survey());
  std::vector<survey::Index> all;
  if (box.empty()) return all;
  for (std::int64_t i = box.lo[0] - reach; i < box.hi[0] + reach; ++i) {
    for (std::int64_t j = box.lo[1] - reach; j < box.hi[1] + reach; ++j) {
      for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) all.push_back({i, j, k});
    }
  }
  return all;
}

// Blocks of side^3 around each voxel, clipped to the owner's box that the voxel lies in.
std::int64_t voxels_of_blocks(const Case& c, const std::pair<int, int>& pair, const Voxels& asked,
                              std::int64_t side) {
  Voxels sent;
  const std::int64_t before = side / 2;
  for (const survey::Index& p : asked) {
    for (const survey::Box& box : c.grid.boxes(pair.first)) {
      if (!box.contains(p)) continue;
      for (std::int64_t i = p[0] - before; i < p[0] - before + side; ++i) {
        for (std::int64_t j = p[1] - before; j < p[1] - before + side; ++j) {
          for (std::int64_t k = p[2] - before; k < p[2] - before + side; ++k) {
            if (box.contains({i, j, k}) && !held(c.grid, pair.second, {i, j, k})) sent.insert({i, j, k});
          }
        }
      }
    }
  }
  return static_cast<std::int64_t>(sent.size());
}

std::int64_t sum(const ByPair& sets) {
  std::int64_t voxels = 0;
  for (const auto& [pair, set] : sets) voxels += static_cast<std::int64_t>(set.size());
  return voxels;
}

TEST(Replay, SendsWhatTheDefinitionsSay) {
  std::mt19937_64 random(41);
  std::int64_t seen = 0;
  for (int round = 0; round < 12; ++round) {
    const Case c = random_case(random);
    const int reach = round % 2;
    SCOPED_TRACE(fmt::format("round {}, {} ranks, reach {}", round, c.grid.ranks(), reach));
    const Pieces pieces = pieces_of(c.grid, c.faces);
    const auto sent = [&](const char* strategy) {
      return sent_by(c.grid, c.faces, pieces, c.responsible, parse_choice(strategy), reach);
    };
    const ByPair needed = missing(c, [&](const Face& face) { return looked_at(c, face, reach); });
    const auto pairs = static_cast<std::int64_t>(needed.size());
    const Sent push = sent("push");
    EXPECT_EQ(push.voxels, sum(needed));
    EXPECT_EQ(push.bytes, 4 * sum(needed));
    EXPECT_EQ(push.messages, pairs);
    const Sent minimum = sent("minimum");
    EXPECT_EQ(minimum.bytes, 16 * sum(needed));
    EXPECT_EQ(minimum.messages, 2 * pairs);
    EXPECT_EQ(sent("block=1").bytes, minimum.bytes);
    for (const std::int64_t side : {2, 3}) {
      std::int64_t voxels = 0;
      for (const auto& [pair, set] : needed) voxels += voxels_of_blocks(c, pair, set, side);
      EXPECT_EQ(sent(fmt::format("block={}", side).c_str()).bytes, 12 * sum(needed) + 4 * voxels) << side;
    }
    const ByPair boxes = missing(c, [&](const Face& face) { return bounding(c, face, reach); });
    EXPECT_EQ(sent("bounding").bytes, 4 * sum(boxes));
    EXPECT_EQ(sent("bounding").messages, static_cast<std::int64_t>(boxes.size()));
    std::int64_t out = 0;
    std::int64_t in = 0;
    for (const Traffic& rank : minimum.of_rank) {
      out += rank.bytes_out;
      in += rank.bytes_in;
    }
    EXPECT_EQ(out, minimum.bytes);
    EXPECT_EQ(in, minimum.bytes);
    seen += sum(needed);
  }
  EXPECT_GT(seen, 1000);
  EXPECT_THROW(sent_by(comm::RankGrid({1, 1, 1}, 1), {}, pieces_of(comm::RankGrid({1, 1, 1}, 1), {}), {},
                       parse_choice("sideways")),
               Error);
}

TEST(Replay, CountsPiecesByOwner) {
  std::mt19937_64 random(42);
  for (int round = 0; round < 6; ++round) {
    const Case c = random_case(random);
    const Pieces pieces = pieces_of(c.grid, c.faces);
    const Amounts amounts = amounts_of(c.grid, c.faces, pieces, c.responsible);
    std::vector<std::int64_t> owned(static_cast<std::size_t>(c.grid.ranks()), 0);
    std::vector<std::int64_t> walked = owned;
    std::map<std::pair<int, int>, std::int64_t> remote;
    std::int64_t reduce = 0;
    for (std::size_t n = 0; n < c.faces.size(); ++n) {
      std::map<int, std::int64_t> by_owner;
      for (const survey::Index& p : looked_at(c, c.faces[n], 0)) ++by_owner[c.grid.owner(p)];
      ASSERT_EQ(pieces.first[n + 1] - pieces.first[n], by_owner.size());
      std::size_t at = pieces.first[n];
      for (const auto& [owner, voxels] : by_owner) {
        EXPECT_EQ(pieces.all[at].owner, owner);
        EXPECT_EQ(pieces.all[at++].voxels, voxels);
        owned[static_cast<std::size_t>(owner)] += voxels;
        walked[static_cast<std::size_t>(c.responsible[n])] += voxels;
        if (owner == c.responsible[n]) continue;
        remote[{owner, c.responsible[n]}] += voxels;
        ++reduce;
      }
    }
    EXPECT_EQ(amounts.owned, owned);
    EXPECT_EQ(amounts.voxels, walked);
    ASSERT_EQ(amounts.pairs.size(), remote.size());
    std::size_t at = 0;
    for (const auto& [pair, voxels] : remote) {
      EXPECT_EQ(std::pair(amounts.pairs[at].from, amounts.pairs[at].to), pair);
      EXPECT_EQ(amounts.pairs[at++].voxels, voxels);
    }
    const Sent sent = sent_by(c.grid, c.faces, pieces, c.responsible, parse_choice("reduce"));
    EXPECT_EQ(sent.bytes, reduce * kPartialBytes);
    EXPECT_FALSE(sent.exact);
  }
}

}  // namespace
}  // namespace footwall::extract
