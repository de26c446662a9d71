#include "engine/isosurface/grid_topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "engine/isosurface/seed_tables.h"
#include "engine/verify/trilinear_level_set.h"
#include "rounds.h"

namespace footwall::isosurface {
namespace {

struct Grid {
  std::int64_t n;
  std::vector<float> values;

  Field field() const { return {values, {n, n, n}, {0, 0, 0}, {n, n, n}}; }
  SurfaceForm form(float isovalue = 0, const CaseRules& rules = trilinear_rules()) const {
    return form_of(triangles_by_cell(field(), isovalue, rules), {n, n, n});
  }
};

Grid random_grid(std::int64_t n, int most, std::mt19937_64& random) {
  Grid grid{n, std::vector<float>(static_cast<std::size_t>(n * n * n))};
  std::uniform_int_distribution<int> value(-most, most);
  for (float& each : grid.values) each = static_cast<float>(value(random));
  return grid;
}

TEST(GridTopology, ACornerABallAndATorus) {
  Grid grid{5, std::vector<float>(125, -1)};
  grid.values[0] = 1;
  SurfaceForm form = grid.form();
  EXPECT_EQ(form.triangles, 1);
  EXPECT_EQ(form.border_edges, 3);
  EXPECT_EQ(form.open_edges, 0);
  EXPECT_EQ(form.euler, 1);
  EXPECT_EQ(form.genus, 0);

  grid.values[0] = -1;
  grid.values[62] = 1;
  form = grid.form();
  EXPECT_EQ(form.vertices, 6);
  EXPECT_EQ(form.triangles, 8);
  EXPECT_EQ(form.euler, 2);
  EXPECT_EQ(form.border_edges, 0);

  for (std::size_t n = 0; n < 9; ++n) grid.values[50 + 6 + n % 3 + 5 * (n / 3)] = n == 4 ? -9 : 1;
  form = grid.form();
  EXPECT_EQ(form.components, 1);
  EXPECT_EQ(form.genus, 1);
}

TEST(GridTopology, RandomGridsHaveTheFormOfTheTrilinearField) {
  std::mt19937_64 random(3);
  int compared = 0;
  const int grids = rounds(60);
  for (int round = 0; round < grids; ++round) {
    const Grid grid = random_grid(6, round % 3 == 0 ? 3 : 1000, random);
    const SurfaceForm form = grid.form();
    ASSERT_EQ(form.open_edges, 0) << round;
    ASSERT_EQ(form.crowded_edges, 0) << round;
    ASSERT_EQ(form.twisted_edges, 0) << round;
    const auto sampled =
        verify::grid_euler_number(std::vector<double>(grid.values.begin(), grid.values.end()), 6);
    if (!sampled) continue;
    ++compared;
    ASSERT_EQ(form.euler, *sampled) << round;
  }
  EXPECT_GT(compared, grids / 2);
}

TEST(GridTopology, ANullTakesItsCellsOutAndLeavesACleanBorder) {
  std::mt19937_64 random(4);
  Grid grid = random_grid(6, 1000, random);
  grid.values[43] = std::numeric_limits<float>::quiet_NaN();
  const SurfaceForm form = grid.form();
  EXPECT_GT(form.open_edges, 0);
  EXPECT_EQ(form.crowded_edges, 0);
  EXPECT_EQ(form.twisted_edges, 0);
}

// Noise has all kinds of ambiguous faces: two cells of seed 002 cut some of them in different ways. Seed 000
// leaves no crack; that its fans share chords on faces and miss tunnels is what it is compared for.
TEST(GridTopology, TheSeedsRulesLeaveWhatTheyAreKnownFor) {
  std::mt19937_64 random(12);
  const Grid grid = random_grid(12, 1000, random);
  EXPECT_GT(grid.form(0, rules_of("seed002")).open_edges, 0);
  EXPECT_EQ(grid.form(0, rules_of("seed000")).open_edges, 0);
  EXPECT_EQ(grid.form(0, rules_of("trilinear")).open_edges, 0);
  EXPECT_NE(grid.form(0, rules_of("seed000")).euler, grid.form().euler);
}

}  // namespace
}  // namespace footwall::isosurface
