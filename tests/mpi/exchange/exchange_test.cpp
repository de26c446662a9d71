// The strategies that move voxels: over extraction after extraction, with their cache and its limit, and with
// what they send counted by another than themselves.
#include "engine/extract/exchange/exchange.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/extract/balance/none.h"
#include "engine/extract/statistics/discontinuity.h"
#include "engine/voxelize/registry.h"
#include "mpi/extract/random_case.h"
#include "profiled_calls.h"

namespace footwall::extract {
namespace {

const std::vector<std::string> kAll{"reduce", "minimum", "block=1", "block=5", "bounding", "push"};
const std::vector<std::string> kMoving{"minimum", "block=2", "bounding", "push"};

Options options_of(const std::string& exchange, bool with_discontinuity) {
  Options options;
  options.exchange = exchange;
  options.compute = {"mean", "variance"};
  if (with_discontinuity) options.compute.push_back("discontinuity");
  return options;
}

class Exchange : public testing::TestWithParam<std::tuple<bool, std::array<int, 2>>> {
 protected:
  bool with_discontinuity() const { return std::get<0>(GetParam()); }
  std::array<int, 2> pillars() const { return std::get<1>(GetParam()); }
};

TEST_P(Exchange, EveryStrategyGivesTheSameBitsExtractionAfterExtraction) {
  const comm::Communicator world(MPI_COMM_WORLD);
  Case c = random_case({43, 38, 29}, 40, 21);
  for (const std::string& exchange : kAll) {
    SCOPED_TRACE(exchange);
    Case moved = c;
    LoadedSurvey survey(world, c.dims, c.reader(), {}, pillars());
    for (unsigned cycle = 0; cycle < 3; ++cycle) {
      const Result got = survey.extract(moved.input(), options_of(exchange, with_discontinuity()));
      const Result want = survey.extract(moved.input(), options_of("reduce", with_discontinuity()));
      EXPECT_EQ(got.report.checksum, want.report.checksum) << "cycle " << cycle;
      EXPECT_EQ(got.report.voxels, want.report.voxels);
      EXPECT_EQ(got.report.exchange, exchange);
      move_some(moved, cycle);
    }
  }
}

TEST_P(Exchange, IsTheDefinition) {
  const comm::Communicator world(MPI_COMM_WORLD);
  const Case c = random_case({26, 31, 19}, 30, 22);
  std::vector<FaceStatistics> truth;
  if (world.rank() == 0) truth = by_definition(c);
  if (!with_discontinuity()) {
    for (FaceStatistics& face : truth) face.discontinuity = kUndefined;
  }
  for (const std::string& exchange : kMoving) {
    SCOPED_TRACE(exchange);
    LoadedSurvey survey(world, c.dims, c.reader(), {}, pillars());
    const Result got = survey.extract(c.input(), options_of(exchange, with_discontinuity()));
    if (world.rank() == 0) expect_equal(got.faces, truth);
  }
}

TEST_P(Exchange, PhasesApartGiveTheSameAndTellTheWaiting) {
  const comm::Communicator world(MPI_COMM_WORLD);
  Case c = random_case({43, 38, 29}, 40, 23);
  for (const std::string& exchange : kAll) {
    SCOPED_TRACE(exchange);
    LoadedSurvey survey(world, c.dims, c.reader(), {}, pillars());
    Options options = options_of(exchange, with_discontinuity());
    const Report usual = survey.extract(c.input(), options).report;
    EXPECT_EQ(usual.seconds.wait, 0);
    survey.forget_cache();
    options.phases_apart = true;
    const Report apart = survey.extract(c.input(), options).report;
    EXPECT_EQ(apart.checksum, usual.checksum);
    EXPECT_EQ(apart.bytes_sent, usual.bytes_sent);
    EXPECT_EQ(apart.messages, usual.messages);
    EXPECT_GE(apart.most_bytes * world.size(), apart.bytes_sent);
    EXPECT_LE(apart.most_bytes, apart.bytes_sent);
    EXPECT_GE(apart.most_messages * world.size(), apart.messages);
    EXPECT_LE(apart.most_messages, apart.messages);
    EXPECT_EQ(apart.seconds.wait > 0, world.size() > 1);
    const Seconds& s = apart.seconds;
    EXPECT_LE(apart.quickest.wait, s.wait);
    EXPECT_LE(std::max({s.balance, s.voxelize, s.exchange, s.compute, s.wait}), s.total);
  }
}

// Both sides of a pair must drop the same bricks, or push would miss voxels and minimum send them twice.
TEST_P(Exchange, ATinyCacheForgetsAlikeOnBothSides) {
  const comm::Communicator world(MPI_COMM_WORLD);
  const Case c = random_case({43, 38, 29}, 30, 23);
  for (const std::int64_t bricks : {0, 2, 40}) {
    SCOPED_TRACE(bricks);
    Case moved = c;
    LoadedSurvey survey(world, c.dims, c.reader(), {}, pillars());
    for (unsigned cycle = 0; cycle < 6; ++cycle) {
      const std::string& exchange = kMoving[(cycle * 7 + static_cast<unsigned>(bricks)) % kMoving.size()];
      SCOPED_TRACE(exchange);
      Options options = options_of(exchange, with_discontinuity());
      options.cache_bytes = bricks * kBytesPerBrick * std::max(world.size() - 1, 1);
      const Result got = survey.extract(moved.input(), options);
      const Result want = survey.extract(moved.input(), options_of("reduce", with_discontinuity()));
      EXPECT_EQ(got.report.checksum, want.report.checksum) << "cycle " << cycle;
      EXPECT_LE(got.report.cache_voxels, bricks * kBrickVoxels * world.size() * (world.size() - 1));
      if (cycle % 2 == 1) move_some(moved, cycle);
    }
  }
}

TEST_P(Exchange, WhatWasMovedOnceIsNotMovedAgain) {
  const comm::Communicator world(MPI_COMM_WORLD);
  const Case c = random_case({43, 38, 29}, 60, 24);
  const auto sizes = std::int64_t{8} * world.size() * (world.size() - 1);
  for (const std::string& exchange : kMoving) {
    SCOPED_TRACE(exchange);
    LoadedSurvey survey(world, c.dims, c.reader(), {}, pillars());
    const Options options = options_of(exchange, with_discontinuity());
    const Report first = survey.extract(c.input(), options).report;
    EXPECT_EQ(first.cache_hits, 0);
    if (world.size() > 1) {
      EXPECT_GT(first.cache_voxels, 0);
    }
    const Report second = survey.extract(c.input(), options).report;
    EXPECT_EQ(second.bytes_sent, exchange == "push" ? 0 : sizes);
    EXPECT_EQ(second.cache_voxels, first.cache_voxels);
    if (exchange == "push" || exchange == "minimum") {
      EXPECT_EQ(second.cache_hits, first.cache_voxels);
    }
    // What any strategy moved, the others know of.
    for (const std::string& other : kMoving) {
      if (other == "bounding") continue;  // needs more than the others moved
      EXPECT_EQ(survey.extract(c.input(), options_of(other, with_discontinuity())).report.bytes_sent,
                other == "push" ? 0 : sizes)
          << other;
    }
    survey.forget_cache();
    const Report again = survey.extract(c.input(), options).report;
    EXPECT_EQ(again.bytes_sent, first.bytes_sent);
    EXPECT_EQ(again.cache_hits, 0);
  }
}

TEST_P(Exchange, ABlockOfOneVoxelIsMinimum) {
  const comm::Communicator world(MPI_COMM_WORLD);
  Case c = random_case({43, 38, 29}, 60, 25);
  LoadedSurvey one(world, c.dims, c.reader(), {}, pillars());
  LoadedSurvey other(world, c.dims, c.reader(), {}, pillars());
  LoadedSurvey larger(world, c.dims, c.reader(), {}, pillars());
  for (unsigned cycle = 0; cycle < 3; ++cycle) {
    const Report minimum = one.extract(c.input(), options_of("minimum", with_discontinuity())).report;
    const Report block = other.extract(c.input(), options_of("block=1", with_discontinuity())).report;
    const Report three = larger.extract(c.input(), options_of("block=3", with_discontinuity())).report;
    EXPECT_EQ(minimum.bytes_sent, block.bytes_sent);
    EXPECT_EQ(minimum.messages, block.messages);
    EXPECT_EQ(minimum.cache_voxels, block.cache_voxels);
    if (world.size() > 1) {
      EXPECT_GT(three.cache_voxels, minimum.cache_voxels);
    }
    move_some(c, cycle);
  }
}

TEST_P(Exchange, PushSendsAtMostAQuarterOfMinimum) {
  const comm::Communicator world(MPI_COMM_WORLD);
  Case c = random_case({100, 100, 50}, 0, 26);
  std::mt19937_64 random(27);
  for (int n = 0; n < 120; ++n) {  // legs of 45 voxels: an area near 1,000, as in the seed's benchmark 1
    Face face{1, n, 0, {}};
    const auto at = [&](int most) {
      return static_cast<std::int32_t>(random() % (static_cast<unsigned>(most) * 256));
    };
    const survey::LatticePoint p{at(54), at(54), at(4)};
    face.triangle = {p, {p.i + 45 * 256, p.j + at(8), p.k}, {p.i + at(8), p.j + at(45), p.k + 45 * 256}};
    c.faces.push_back(face);
  }
  LoadedSurvey survey(world, c.dims, c.reader(), {}, pillars());
  const Report minimum = survey.extract(c.input(), options_of("minimum", with_discontinuity())).report;
  survey.forget_cache();
  const Report push = survey.extract(c.input(), options_of("push", with_discontinuity())).report;
  EXPECT_EQ(push.checksum, minimum.checksum);
  EXPECT_EQ(push.cache_voxels, minimum.cache_voxels);
  EXPECT_EQ(push.bytes_sent, push.cache_voxels * 4);
  EXPECT_LE(static_cast<double>(push.bytes_sent), 0.26 * static_cast<double>(minimum.bytes_sent));
  EXPECT_LE(push.messages, world.size() * (world.size() - 1));
}

INSTANTIATE_TEST_SUITE_P(Layouts, Exchange,
                         testing::Combine(testing::Bool(), testing::Values(std::array<int, 2>{1, 1},
                                                                           std::array<int, 2>{2, 3})),
                         [](const auto& chosen) {
                           return std::string(std::get<0>(chosen.param) ? "discontinuity_" : "moments_") +
                                  (std::get<1>(chosen.param)[0] > 1 ? "interleaved" : "plain");
                         });

TEST(ExchangeOfOddSurveys, RanksWithoutVoxelsAndFacesWithoutAny) {
  const comm::Communicator world(MPI_COMM_WORLD);
  for (const survey::Index dims : {survey::Index{1, 1, 1}, {2, 1, 40}, {30, 40, 1}, {9, 1, 5}}) {
    const Case c = random_case(dims, 40, 28);
    for (const std::array<int, 2> pillars : {std::array<int, 2>{1, 1}, std::array<int, 2>{3, 2}}) {
      LoadedSurvey survey(world, c.dims, c.reader(), {}, pillars);
      const std::uint64_t want = survey.extract(c.input(), options_of("reduce", true)).report.checksum;
      for (const std::string& exchange : kMoving) {
        EXPECT_EQ(survey.extract(c.input(), options_of(exchange, true)).report.checksum, want) << exchange;
        survey.forget_cache();
      }
    }
  }
}

// Strategies run by hand, so that nothing else is sent between two looks at the counters.
struct Bench {
  Bench(const comm::Communicator& parent, const Case& c, std::array<int, 2> pillars)
      : grid(c.dims, parent.size(), pillars),
        world(parent, grid),
        blocks(grid, world.rank()),
        cache(grid, blocks),
        sent(grid, world.rank()) {
    for (Block& block : blocks.all()) {
      std::vector<float> values(static_cast<std::size_t>(block.wanted().count()));
      c.reader()(block.wanted(), values);
      block.put(block.wanted(), values);
    }
  }
  Outcome run(const Case& c, const std::string& exchange, bool with_discontinuity,
              std::span<const Computation* const> whole_face = {}) {
    const Options options = options_of(exchange, with_discontinuity);
    const Input input = c.input();
    const Choice choice = parse_choice(exchange);
    const Choice none = parse_choice("none");
    const std::vector<int> responsible = balance_none({grid, input.faces, none, {}});
    const JobContext job;
    cache.begin_extraction();
    sent.begin_extraction();
    return exchange_strategy(choice.name)
        .run({world, grid, blocks, cache, sent, input, responsible, options, choice, with_discontinuity,
              discontinuity_scale(input.max_abs), whole_face, 1, kept, job});
  }
  comm::RankGrid grid;
  comm::Communicator world;
  Blocks blocks;
  VoxelCache cache;
  SentRecord sent;
  Kept kept;
};

TEST(ExchangeTraffic, IsWhatTheProfilingLayerCounts) {
  const comm::Communicator parent(MPI_COMM_WORLD);
  Case c = random_case({43, 38, 29}, 60, 29);
  for (const std::array<int, 2> pillars : {std::array<int, 2>{1, 1}, std::array<int, 2>{2, 2}}) {
    for (const std::string& exchange : kAll) {
      SCOPED_TRACE(exchange);
      Bench bench(parent, c, pillars);
      Case moved = c;
      std::int64_t total = 0;
      for (unsigned cycle = 0; cycle < 3; ++cycle) {
        const ProfiledCalls before = profiled_calls();
        const comm::Traffic mine = bench.world.traffic();
        bench.run(moved, exchange, true);
        const ProfiledCalls after = profiled_calls();
        EXPECT_EQ(bench.world.traffic().bytes - mine.bytes, after.bytes - before.bytes);
        EXPECT_EQ(bench.world.traffic().messages - mine.messages, after.messages - before.messages);
        total += after.bytes - before.bytes;
        move_some(moved, cycle);
      }
      if (parent.size() > 1) {
        EXPECT_GT(bench.world.sum(total), 0);
      } else {
        EXPECT_EQ(total, 0);
      }
    }
  }
}

// Hands back what it is given.
class Copy final : public WholeFace {
 public:
  void compute(const FaceVoxels& face, std::vector<std::byte>& out) override {
    const auto raw = std::as_bytes(face.values);
    out.insert(out.end(), raw.begin(), raw.end());
  }
};

TEST(ExchangeOfWholeFaces, ComputationsGetAllValuesInCanonicalOrder) {
  const comm::Communicator parent(MPI_COMM_WORLD);
  const Case c = random_case({43, 38, 29}, 60, 30);
  const Computation copy{"copy", "", "1", true, false, 0, [](const Options&) -> std::unique_ptr<WholeFace> {
                           return std::make_unique<Copy>();
                         }};
  const std::array<const Computation*, 2> whole_face{&copy, &copy};
  for (const bool with_discontinuity : {false, true}) {
    for (const std::string& exchange : kMoving) {
      SCOPED_TRACE(exchange);
      Bench bench(parent, c, {1, 2});
      const Outcome outcome = bench.run(c, exchange, with_discontinuity, whole_face);
      EXPECT_EQ(outcome.blobs.size(), outcome.finished.size() * 2);
      const auto voxelizer = voxelize::make_voxelizer();
      for (const FinishedBlob& blob : outcome.blobs) {
        FaceRows rows;
        voxelizer->rows(c.faces[static_cast<std::size_t>(blob.face)].triangle, {{0, 0, 0}, c.dims}, rows);
        ASSERT_EQ(static_cast<std::int64_t>(blob.bytes.size()), rows.voxels() * 4) << blob.face;
        std::vector<std::uint32_t> want;
        rows.for_each([&](const survey::Index& p) { want.push_back(std::bit_cast<std::uint32_t>(c.at(p))); });
        std::vector<std::uint32_t> got(want.size());
        if (!got.empty()) std::memcpy(got.data(), blob.bytes.data(), blob.bytes.size());
        EXPECT_EQ(got, want) << blob.face;
      }
    }
  }
}

// Cancelled on one rank in the middle: nobody hangs, and the next extraction is right, though the ranks may
// have been at different places when it happened.
TEST(ExchangeErrors, AfterACancelTheCacheStartsAnew) {
  const comm::Communicator world(MPI_COMM_WORLD);
  Case c = random_case({43, 38, 29}, 60, 31);
  LoadedSurvey survey(world, c.dims, c.reader());
  for (const std::string& exchange : kMoving) {
    SCOPED_TRACE(exchange);
    survey.extract(c.input(), options_of(exchange, true));
    move_some(c, 5);
    const JobContext job;
    if (world.rank() == world.size() - 1) job.cancel();
    EXPECT_THROW(survey.extract(c.input(), options_of(exchange, true), job), Error);
    const std::uint64_t want = survey.extract(c.input(), options_of("reduce", true)).report.checksum;
    const Report report = survey.extract(c.input(), options_of(exchange, true)).report;
    EXPECT_EQ(report.checksum, want);
    EXPECT_EQ(report.cache_hits, 0);
  }
}

}  // namespace
}  // namespace footwall::extract
