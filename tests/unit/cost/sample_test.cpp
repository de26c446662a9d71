#include "engine/extract/cost/sample.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "engine/extract/balance/none.h"
#include "engine/voxelize/exact.h"
#include "random_faces.h"
#include "storage/base/error.h"

namespace footwall::extract {
namespace {

constexpr survey::Index kDims{120, 90, 60};

std::vector<int> centroid_ranks(const comm::RankGrid& grid, std::span<const Face> faces) {
  const Choice none = parse_choice("none");
  return balance_none({grid, faces, none, {}});
}

// The definition: voxelize all, look at every voxel.
std::vector<RankAmounts> counted(const comm::RankGrid& grid, std::span<const Face> faces,
                                 std::span<const int> responsible) {
  std::vector<RankAmounts> ranks(static_cast<std::size_t>(grid.ranks()));
  voxelize::ExactScratch scratch;
  std::set<std::tuple<int, survey::Index>> moved;
  std::set<std::tuple<int, int>> pairs;
  for (std::size_t n = 0; n < faces.size(); ++n) {
    const int to = responsible[n];
    ranks[static_cast<std::size_t>(to)].faces += 1;
    std::set<int> owners;
    voxelize::for_each_voxel(faces[n].triangle, {{0, 0, 0}, grid.dims()}, scratch,
                             [&](const survey::Index& p) {
                               const int from = grid.owner(p);
                               ranks[static_cast<std::size_t>(to)].voxels += 1;
                               ranks[static_cast<std::size_t>(from)].owned += 1;
                               if (from == to) return;
                               ranks[static_cast<std::size_t>(from)].owned_elsewhere += 1;
                               owners.insert(from);
                               if (!moved.insert({to, p}).second) return;
                               ranks[static_cast<std::size_t>(to)].received += 1;
                               ranks[static_cast<std::size_t>(from)].sent += 1;
                             });
    for (const int from : owners) {
      ranks[static_cast<std::size_t>(to)].pieces_received += 1;
      ranks[static_cast<std::size_t>(from)].pieces_sent += 1;
      if (!pairs.insert({from, to}).second) continue;
      ranks[static_cast<std::size_t>(to)].partners_received += 1;
      ranks[static_cast<std::size_t>(from)].partners_sent += 1;
    }
  }
  return ranks;
}

void expect_near(double estimate, double truth, double share, const char* what) {
  EXPECT_NEAR(estimate, truth, share * truth + 1) << what;
}

// Close enough to tell strategies apart; what is distinct is guessed high, because it crowds at the borders.
TEST(FaceSample, EstimatesWhatVoxelizingEverythingCounts) {
  const comm::RankGrid grid(kDims, 4);
  const std::vector<Face> faces = random_faces(kDims, 1500, 36, 3);
  const std::vector<int> responsible = centroid_ranks(grid, faces);
  const FaceSample sample(grid, faces, 0);
  const std::vector<RankAmounts> estimated = sample.amounts(responsible, expected_voxels(faces, kDims));
  const std::vector<RankAmounts> truth = counted(grid, faces, responsible);
  for (std::size_t rank = 0; rank < 4; ++rank) {
    EXPECT_EQ(estimated[rank].faces, truth[rank].faces);
    expect_near(estimated[rank].voxels, truth[rank].voxels, 0.05, "voxels");
    expect_near(estimated[rank].owned, truth[rank].owned, 0.1, "owned");
    expect_near(estimated[rank].owned_elsewhere, truth[rank].owned_elsewhere, 0.2, "owned elsewhere");
    expect_near(estimated[rank].received, truth[rank].received, 0.45, "received");
    expect_near(estimated[rank].sent, truth[rank].sent, 0.45, "sent");
    expect_near(estimated[rank].pieces_received, truth[rank].pieces_received, 0.35, "pieces");
    EXPECT_EQ(estimated[rank].partners_received, truth[rank].partners_received);
    EXPECT_LT(estimated[rank].received, estimated[rank].blocks_received[0]);
    EXPECT_LT(estimated[rank].blocks_received[0], estimated[rank].blocks_received[1]);
    EXPECT_LT(estimated[rank].blocks_received[0], estimated[rank].bounding_received);
  }
}

TEST(FaceSample, CountsOnlyWhatIsInsideTheSurvey) {
  std::vector<Face> faces = random_faces(kDims, 400, 30, 9);
  for (Face& face : faces) {
    for (survey::LatticePoint& p : face.triangle) p.i -= 60 * 256;  // about half of them leave it
  }
  voxelize::ExactScratch scratch;
  double truth = 0;
  double estimated = 0;
  for (const Face& face : faces)
    truth += static_cast<double>(voxelize::count(face.triangle, {{0, 0, 0}, kDims}, scratch));
  for (const std::int64_t voxels : expected_voxels(faces, kDims)) estimated += static_cast<double>(voxels);
  EXPECT_GT(truth, 0);
  expect_near(estimated, truth, 0.05, "voxels");
}

TEST(FaceSample, SurvivesUglyFaces) {
  // A point, a needle, the lattice's ends, a face wholly outside, one voxel of survey, more ranks than lines.
  constexpr std::int32_t kEnd = 2147483647;
  std::vector<Face> faces(4);
  faces[0].triangle = {survey::LatticePoint{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  faces[1].triangle = {survey::LatticePoint{0, 0, 0}, {256, 0, 0}, {512, 0, 0}};
  faces[2].triangle = {survey::LatticePoint{-kEnd, -kEnd, -kEnd}, {kEnd, -kEnd, kEnd}, {0, kEnd, -kEnd}};
  faces[3].triangle = {survey::LatticePoint{-9000, -9000, 0}, {-8000, -9000, 0}, {-9000, -8000, 0}};
  for (const survey::Index dims : {survey::Index{1, 1, 1}, survey::Index{2, 3, 5}}) {
    const comm::RankGrid grid(dims, 7);
    const FaceSample sample(grid, faces, 1);
    const std::vector<std::int64_t> voxels = expected_voxels(faces, dims);
    const double volume = static_cast<double>(dims[0] * dims[1] * dims[2]);
    for (const std::int64_t each : voxels) {
      EXPECT_GE(each, 0);
      EXPECT_LE(static_cast<double>(each), volume);
    }
    EXPECT_EQ(voxels[3], 0);
    for (const RankAmounts& rank : sample.amounts(std::vector<int>{0, 1, 2, 3}, voxels)) {
      EXPECT_LE(rank.received, volume);
      EXPECT_GE(rank.received, 0);
    }
  }
  EXPECT_THROW(FaceSample(comm::RankGrid({4, 4, 4}, 2), faces, 0).amounts(std::vector<int>{0}, {}), Error);
}

}  // namespace
}  // namespace footwall::extract
