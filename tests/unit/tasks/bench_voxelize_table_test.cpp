#include "engine/tasks/bench_voxelize_table.h"

#include <gtest/gtest.h>

#include <set>

#include "engine/tasks/bench_gather.h"
#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

ErrorCode code_of(const VoxelizeTableOptions& options) {
  try {
    bench_voxelize_table(options, JobContext());
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::kInternal;
}

VoxelizeTableOptions sample_run() {
  VoxelizeTableOptions options;
  options.vertices = {{{15, 12, 5}, {10, 5, 2}, {4, 3, 6}}};
  options.runs = 2;
  return options;
}

// The seed's sample run prints 100.67522/192.60841/17.83255.
TEST(BenchVoxelizeTable, AreasAreThoseOfTheSeedsSampleRun) {
  const VoxelizeTable table = bench_voxelize_table(sample_run(), JobContext());
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_NEAR(table.rows[0].mean_area, 100.67522, 5e-4);
  EXPECT_NEAR(table.rows[0].max_area, 192.60841, 1e-4);
  EXPECT_NEAR(table.rows[0].min_area, 17.83255, 1e-4);
  EXPECT_EQ(table.triangles, 512);
  EXPECT_EQ(table.check.triangles, 64);
}

TEST(BenchVoxelizeTable, TakesAllSignsOrOneTriangle) {
  const VertexTriple triple = {{{1, 2, 3}, {4, 5, 6}, {7, 8, 10}}};
  std::set<std::array<std::int32_t, 9>> seen;
  for (const survey::LatticeTriangle& t : sign_triangles(triple, false)) {
    seen.insert({t[0].i, t[0].j, t[0].k, t[1].i, t[1].j, t[1].k, t[2].i, t[2].j, t[2].k});
  }
  EXPECT_EQ(seen.size(), 512u);
  const auto same = sign_triangles(triple, true);
  EXPECT_EQ(same.size(), 512u);
  EXPECT_EQ(same.front(), same.back());
}

TEST(BenchVoxelizeTable, FindsTriplesOfTheMeanAreasAsked) {
  for (const bool one : {false, true}) {
    VoxelizeTableOptions options;
    options.areas = {10, 1000};
    options.threads = {1, 2};
    options.runs = 1;
    options.one_triangle = one;
    const VoxelizeTable table = bench_voxelize_table(options, JobContext());
    ASSERT_EQ(table.rows.size(), 4u);
    for (const VoxelizeTableRow& row : table.rows)
      EXPECT_NEAR(row.mean_area, row.asked_area, 0.01 * row.asked_area);
    EXPECT_EQ(table.rows[0].voxels, table.rows[1].voxels);
    EXPECT_EQ(table.rows[1].threads, 2);
  }
}

TEST(BenchVoxelizeTable, EveryMethodIsCheckedAndComparedWithExact) {
  VoxelizeTableOptions options = sample_run();
  std::int64_t visits = 0;
  for (const char* name : {"rotated=plain", "rotated"}) {
    options.voxelizer = name;
    const VoxelizeTable table = bench_voxelize_table(options, JobContext());
    EXPECT_GT(table.check.triangles, 40) << name;
    EXPECT_EQ(table.differences.triangles, 512);
    EXPECT_GT(table.differences.missed, table.differences.exact / 3);
    EXPECT_LT(table.differences.extra, table.differences.exact / 100);
    if (visits != 0) {
      EXPECT_EQ(table.rows[0].voxels, visits);
    }
    visits = table.rows[0].voxels;
  }
  options.voxelizer = "kaufman";
  const VoxelizeTable kaufman = bench_voxelize_table(options, JobContext());
  EXPECT_EQ(kaufman.check.triangles, 64);
  EXPECT_EQ(kaufman.differences.repeated, 0);
  // One voxel for each column against 1.76 of the exact cover.
  EXPECT_LT(kaufman.differences.missed, kaufman.differences.exact * 6 / 10);
}

TEST(BenchVoxelizeTable, RefusesWhatCannotBeDone) {
  VoxelizeTableOptions options = sample_run();
  options.voxelizer = "gpu";
  EXPECT_EQ(code_of(options), ErrorCode::kUsage);
  options = sample_run();
  options.runs = 0;
  EXPECT_EQ(code_of(options), ErrorCode::kUsage);
  options = sample_run();
  options.threads = {1, 0};
  EXPECT_EQ(code_of(options), ErrorCode::kUsage);
  options.threads = {1};
  options.areas = {0.5};
  EXPECT_EQ(code_of(options), ErrorCode::kUsage);
  for (const char* bad : {"", "1,2", "1,2,x", "1,2,3,4"}) EXPECT_THROW(parse_vertex(bad), Error) << bad;
  EXPECT_EQ(parse_vertex("-1,2.5,3").j, 2.5);
}

TEST(BenchGather, ChecksTheSumsAndCountsEveryFace) {
  GatherOptions options;
  options.voxels = 20000;
  options.runs = 1;
  options.areas = {100, 5000};
  const GatherResult result = bench_gather(options, JobContext());
  ASSERT_EQ(result.rows.size(), 2u);
  EXPECT_GE(result.rows[0].voxels, 20000);
  EXPECT_GT(result.rows[0].folded_ordered, 0);
  EXPECT_GT(result.checked_faces, 20);
  options.voxelizer = "rotated";
  EXPECT_THROW(bench_gather(options, JobContext()), Error);
}

}  // namespace
}  // namespace footwall::tasks
