// The cells and closed grids of Custodio, Etiene, Pesco and Silva, Practical considerations on Marching Cubes
// 33 topological correctness, 2013, with the Euler numbers, components and genera of their trilinear
// surfaces.
#include <gtest/gtest.h>

#include "conformance/formats/real_files.h"
#include "engine/tasks/bench_topology.h"

namespace footwall::tasks {
namespace {

BenchTopologyResult result_of(const char* file, const char* tables) {
  BenchTopologyOptions options;
  options.csv = formats::real_files() / "_derived" / file;
  options.tables = tables;
  return bench_topology(options, JobContext{});
}

TEST(Mc33, AllCellsHaveTheRightEulerNumber) {
  FOOTWALL_NEEDS_REAL_FILES();
  const BenchTopologyResult result = result_of("mc33_cell_cases_open.csv", "trilinear");
  EXPECT_EQ(result.rows, 5000);
  EXPECT_TRUE(result.mismatches.empty());
  EXPECT_EQ(result.crowded_edges, 0);
  // The 26 cells with a tunnel, which seed 000's rules do not look for.
  EXPECT_EQ(result_of("mc33_cell_cases_open.csv", "seed000").mismatches.size(), 26U);
}

TEST(Mc33, AllClosedGridsHaveTheRightComponentsAndGenus) {
  FOOTWALL_NEEDS_REAL_FILES();
  const BenchTopologyResult result = result_of("mc33_closed_5x5x5_open.csv", "trilinear");
  EXPECT_EQ(result.rows, 1290);
  EXPECT_TRUE(result.mismatches.empty());
  EXPECT_EQ(result.open_edges, 0);
  EXPECT_EQ(result.crowded_edges, 0);
  EXPECT_EQ(result_of("mc33_closed_5x5x5_open.csv", "seed000").open_edges, 0);
  EXPECT_GT(result_of("mc33_closed_5x5x5_open.csv", "seed002").open_edges, 10000);
}

}  // namespace
}  // namespace footwall::tasks
