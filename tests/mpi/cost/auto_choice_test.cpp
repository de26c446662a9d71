#include "engine/extract/auto_choice.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/extract/registry.h"

namespace footwall::extract {
namespace {

constexpr survey::Index kDims{48, 40, 36};

std::vector<Face> some_faces(std::size_t count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::vector<Face> faces(count);
  for (std::size_t n = 0; n < count; ++n) {
    faces[n].owner = static_cast<std::int64_t>(n);
    // Crowded at the survey's first inlines, some of them outside.
    const auto from = static_cast<std::int32_t>(random() % 5000) - 1000;
    for (survey::LatticePoint& p : faces[n].triangle) {
      p = {from + static_cast<std::int32_t>(random() % 3000), static_cast<std::int32_t>(random() % 10000),
           static_cast<std::int32_t>(random() % 9000)};
    }
  }
  return faces;
}

Result extracted(LoadedSurvey& survey, const std::vector<Face>& faces, const Options& options) {
  return survey.extract({kDims, 100, faces}, options);
}

void expect_alike(const comm::Communicator& world, const std::string& text) {
  const auto* raw = reinterpret_cast<const std::byte*>(text.data());
  EXPECT_EQ(world.broadcast({raw, raw + text.size()}, 0), comm::Bytes(raw, raw + text.size())) << text;
}

// Whatever auto takes, every rank takes it, says so, and the numbers are those of any other choice.
TEST(AutoChoice, IsAlikeOnAllRanksAndChangesNoNumber) {
  const comm::Communicator world(MPI_COMM_WORLD);
  const auto read = [](const survey::Box& box, std::span<float> values) {
    std::size_t n = 0;
    for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
      for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
        for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k)
          values[n++] = static_cast<float>((i * 7 + j * 13 + k * 29) % 101 - 50);
      }
    }
  };
  LoadedSurvey survey(world, kDims, read);
  for (const char* exchange : {"auto", "minimum", "push", "reduce"}) {
    for (const std::size_t count : {std::size_t{0}, std::size_t{5}, std::size_t{300}, std::size_t{320}}) {
      Options options;
      options.exchange = exchange;
      const std::vector<Face> faces = some_faces(count, 3);
      const Result result = extracted(survey, faces, options);
      const Report& report = result.report;
      expect_alike(world, report.exchange + "|" + report.balance + "|" + report.reason);
      expect_alike(world, std::to_string(report.predicted.total));
      EXPECT_NE(report.exchange, "auto");
      EXPECT_NE(report.balance, "auto");
      EXPECT_NE(report.reason, "");
      Options plain;
      plain.exchange = "reduce";
      plain.balance = "none";
      const Result other = extracted(survey, faces, plain);
      EXPECT_EQ(report.checksum, other.report.checksum);
      EXPECT_EQ(other.report.reason, "");
      EXPECT_EQ(other.report.predicted.total, 0);
      if (world.size() > 1 && count > 0) {
        EXPECT_GT(report.predicted.total, 0);
      }
    }
  }
}

// The model is told apart from the ranks: choose() needs no communicator, and every rank that calls it gets
// the same for any number of ranks.
TEST(AutoChoice, EveryRankComputesTheSameFromTheSame) {
  const comm::Communicator world(MPI_COMM_WORLD);
  MachineRates rates;
  rates.alpha = rates.overhead = 1e-6;
  rates.byte = 1e-10;
  rates.voxelize = rates.gather = rates.fold = rates.fold_discontinuity = rates.pack = 3e-9;
  rates.face = rates.finish = 1e-7;
  rates.balance = 1e-8;
  const std::vector<Face> faces = some_faces(900, 8);
  for (const int ranks : {2, 5, 64}) {
    rates.ranks = rates.cores = ranks;
    Options options;
    options.exchange = "minimum";
    const Chosen chosen = choose({comm::RankGrid(kDims, ranks), faces, options}, rates);
    expect_alike(world, chosen.exchange + "|" + chosen.balance + "|" + chosen.reason);
  }
}

// How often predictions must be wrong until it is chosen anew.
int wrong_ones(AutoChoice& automatic, const comm::RankGrid& grid, const std::vector<Face>& faces) {
  const Options options;
  for (int wrong = 0; wrong < 100; ++wrong) {
    const Chosen chosen = automatic.decide(grid, faces, options);
    if (chosen.is_new) return wrong;
    Report report;
    report.exchange = chosen.exchange;
    report.seconds.voxelize = 1 + 1000 * chosen.predicted.total;
    automatic.learn(report);
  }
  return -1;
}

TEST(AutoChoice, HoldsWhileTheSituationDoesAndGrowsPatient) {
  const comm::Communicator world(MPI_COMM_WORLD);
  if (world.size() == 1) return;  // nothing is predicted
  const comm::RankGrid grid(kDims, world.size());
  const Options options;
  AutoChoice automatic;
  world.collectively([&] { validate(options); });
  automatic.prepare(world, options);
  const std::vector<Face> faces = some_faces(300, 3);
  EXPECT_TRUE(automatic.decide(grid, faces, options).is_new);
  EXPECT_FALSE(automatic.decide(grid, faces, options).is_new);
  EXPECT_TRUE(automatic.decide(grid, some_faces(900, 3), options).is_new);
  const Chosen first = automatic.decide(grid, faces, options);
  EXPECT_TRUE(first.is_new);
  int patience = 2;
  for (int round = 0; round < 3; ++round) {
    EXPECT_EQ(wrong_ones(automatic, grid, faces), patience);
    const Chosen again = automatic.decide(grid, faces, options);
    const bool same = again.exchange == first.exchange && again.balance == first.balance;
    if (!same) break;  // other rates may well make another choice
    patience *= 2;
  }
  Options others;
  others.compute = {"discontinuity"};
  EXPECT_TRUE(automatic.decide(grid, faces, others).is_new);
}

}  // namespace
}  // namespace footwall::extract
