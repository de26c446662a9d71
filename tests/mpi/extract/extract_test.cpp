#include "engine/extract/extract.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "engine/extract/balance/none.h"
#include "mpi/extract/code_of.h"
#include "mpi/extract/random_case.h"
#include "storage/base/hash.h"

namespace footwall::extract {
namespace {

// The definition takes long: once for each case, told apart by values and triangles.
const std::vector<FaceStatistics>& truth_of(const Case& c) {
  static std::map<std::uint64_t, std::vector<FaceStatistics>> known;
  Hasher hasher;
  hasher.add(std::as_bytes(std::span(c.values)));
  for (const Face& face : c.faces) hasher.add(std::as_bytes(std::span(face.triangle)));
  auto found = known.find(hasher.value());
  if (found == known.end()) found = known.emplace(hasher.value(), by_definition(c)).first;
  return found->second;
}

class ExtractAll : public testing::TestWithParam<std::tuple<const char*, int>> {
 protected:
  Options options() const {
    Options options;
    options.exchange = std::get<0>(GetParam());
    options.threads = std::get<1>(GetParam());
    return options;
  }
  // Checks every number on rank 0 and the report on all.
  void check(const Case& c) {
    const comm::Communicator world(MPI_COMM_WORLD);
    const Result result = extract_all(world, c.input(), options(), c.reader());
    EXPECT_EQ(result.report.exchange, options().exchange);
    EXPECT_EQ(result.report.ranks, world.size());
    EXPECT_GE(result.report.load_max_over_mean, 1 - 1e-12);
    if (world.rank() != 0) {
      EXPECT_TRUE(result.faces.empty());
      return;
    }
    const std::vector<FaceStatistics>& truth = truth_of(c);
    expect_equal(result.faces, truth);
    EXPECT_EQ(result.report.checksum, checksum_of(c.faces, truth));
    std::int64_t voxels = 0;
    for (const FaceStatistics& face : truth) voxels += face.count + face.nulls;
    EXPECT_EQ(result.report.voxels, voxels);
    if (world.size() == 1) {
      EXPECT_EQ(result.report.bytes_sent, 0);
      EXPECT_EQ(result.report.messages, 0);
    }
  }
};

TEST_P(ExtractAll, IsTheDefinitionOnRandomFaces) {
  check(random_case({21, 17, 33}, 150, 1));
}
TEST_P(ExtractAll, WorksWithOneVoxel) {
  check(random_case({1, 1, 1}, 30, 2));
}
TEST_P(ExtractAll, WorksWithFewerTracesThanRanks) {
  check(random_case({2, 1, 40}, 40, 3));
}
TEST_P(ExtractAll, WorksWithAFlatSurvey) {
  check(random_case({30, 40, 1}, 40, 4));
}
TEST_P(ExtractAll, WorksWithMoreInlinesThanASlab) {
  check(random_case({150, 5, 9}, 30, 5));
}
TEST_P(ExtractAll, WorksWithoutFaces) {
  check(random_case({5, 5, 5}, 0, 6));
}
TEST_P(ExtractAll, WorksWithNothingButNulls) {
  Case c = random_case({6, 6, 6}, 20, 7);
  std::fill(c.values.begin(), c.values.end(), kNull);
  c.max_abs = 0;
  check(c);
}

TEST_P(ExtractAll, LeavesOutWhatIsNotAskedFor) {
  const Case c = random_case({9, 9, 9}, 20, 8);
  const comm::Communicator world(MPI_COMM_WORLD);
  Options wanted = options();
  wanted.compute = {"variance"};
  const Result result = extract_all(world, c.input(), wanted, c.reader());
  std::vector<FaceStatistics> truth = truth_of(c);
  for (FaceStatistics& face : truth) face.discontinuity = kUndefined;
  if (world.rank() == 0) expect_equal(result.faces, truth);
}

INSTANTIATE_TEST_SUITE_P(StrategiesAndThreads, ExtractAll,
                         testing::Combine(testing::Values("reduce", "minimum", "block=2", "block=5",
                                                          "bounding", "push"),
                                          testing::Values(1, 3)),
                         [](const auto& chosen) {
                           std::string name = std::get<0>(chosen.param);
                           std::replace(name.begin(), name.end(), '=', '_');
                           return name + "_threads_" + std::to_string(std::get<1>(chosen.param));
                         });

TEST(ExtractErrors, OneRanksTroubleEndsTheJobOnAll) {
  const comm::Communicator world(MPI_COMM_WORLD);
  const Case c = random_case({12, 12, 8}, 20, 9);
  const bool last = world.rank() == world.size() - 1;

  // Cancelled on one rank only.
  const JobContext job;
  if (last) job.cancel();
  EXPECT_EQ(code_of([&] { extract_all(world, c.input(), {}, c.reader(), job); }), ErrorCode::kCancelled);

  // One rank's values exceed the recorded maximum.
  Input input = c.input();
  if (world.rank() == 0) input.max_abs = c.max_abs * 1e-9;
  EXPECT_EQ(code_of([&] { extract_all(world, input, {}, c.reader()); }), ErrorCode::kCorrupt);
}

TEST(ExtractErrors, WrongNamesAreWrongUsageOnAllRanks) {
  const comm::Communicator world(MPI_COMM_WORLD);
  const Case c = random_case({4, 4, 4}, 2, 10);
  std::vector<Options> wrong(6);
  wrong[0].exchange = "block=0";
  wrong[1].exchange = "guess";
  wrong[2].balance = "sideways";
  wrong[3].voxelizer = "gpu";
  wrong[4].compute = {"sideways"};
  wrong[5].threads = 0;
  for (const Options& options : wrong) {
    EXPECT_EQ(code_of([&] { extract_all(world, c.input(), options, c.reader()); }), ErrorCode::kUsage);
  }
}

TEST(Centroid, IsRoundedToEvenAndClamped) {
  const survey::Index dims{10, 10, 10};
  const auto at = [](int i, int j, int k) { return survey::LatticePoint{i, j, k}; };
  // Sums of 384 = half of 3 x 256, and 1152 = one and a half.
  EXPECT_EQ(centroid_voxel({at(384, 1152, 0), at(0, 0, 0), at(0, 0, 0)}, dims), (survey::Index{0, 2, 0}));
  EXPECT_EQ(centroid_voxel({at(-5000, 99999, 385), at(0, 0, 0), at(0, 0, 0)}, dims),
            (survey::Index{0, 9, 1}));
}

}  // namespace
}  // namespace footwall::extract
