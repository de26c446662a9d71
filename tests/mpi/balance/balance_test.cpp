// Who is responsible changes no number.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/extract/balance/balance.h"
#include "engine/extract/extract.h"
#include "unit/balance/random_faces.h"

namespace footwall::extract {
namespace {

// Any value is a function of its place.
ReadBox reader() {
  return [](const survey::Box& box, std::span<float> values) {
    std::size_t n = 0;
    for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
      for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
        for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) {
          const std::int64_t mixed = (i * 7919 + j * 104729 + k * 1299709) % 2003;
          values[n++] = static_cast<float>(mixed - 1001) * 0.37F;
        }
      }
    }
  };
}

// Every row, and those with parameters that take other ways. `auto` is mpi_cost's.
std::vector<std::string> all_balancers() {
  std::vector<std::string> all{"global=40", "local=0,cache", "manhattan=40,1"};
  for (const BalanceStrategy& row : balance_strategies()) {
    if (row.name != "auto") all.emplace_back(row.name);
  }
  return all;
}

class BalancedExtract : public testing::TestWithParam<std::string> {};

TEST_P(BalancedExtract, GivesTheStatisticsOfNone) {
  const comm::Communicator world(MPI_COMM_WORLD);
  std::mt19937_64 random(51);
  for (const survey::Index& dims : {survey::Index{30, 24, 20}, survey::Index{2, 1, 30}}) {
    const std::vector<Face> faces = random_faces(dims, 90, random);
    for (const std::array<int, 2> pillars : {std::array{1, 1}, std::array{2, 2}}) {
      LoadedSurvey survey(world, dims, reader(), {}, pillars);
      const Input input{dims, 1001 * 0.37F, faces};
      for (const char* exchange : {"minimum", "reduce"}) {
        Options options;
        options.exchange = exchange;
        options.pillars = pillars;
        options.balance = "none";
        const Result none = survey.extract(input, options);
        options.balance = GetParam();
        const Result balanced = survey.extract(input, options);
        EXPECT_EQ(balanced.report.checksum, none.report.checksum) << exchange;
        EXPECT_EQ(balanced.report.voxels, none.report.voxels);
        EXPECT_EQ(balanced.report.balance, GetParam());
        EXPECT_EQ(balanced.faces.size(), world.rank() == 0 ? faces.size() : 0);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Strategies, BalancedExtract, testing::ValuesIn(all_balancers()),
                         [](const auto& chosen) {
                           std::string name = chosen.param;
                           std::replace_if(
                               name.begin(), name.end(), [](char c) { return c == '=' || c == ','; }, '_');
                           return name;
                         });

}  // namespace
}  // namespace footwall::extract
