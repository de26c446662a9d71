#include "engine/tasks/compare_runs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>

#include "engine/tasks/statistics.h"
#include "scratch_folder.h"
#include "storage/base/error.h"
#include "storage/survey/points.h"

namespace footwall::tasks {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

survey::Geometry metre_survey() {
  survey::Geometry g;
  g.inlines = {100, 1, 60};
  g.crosslines = {300, 1, 60};
  g.samples = 100;
  g.interval = 5;
  g.domain = survey::Domain::kDepth;
  g.vertical_unit = survey::VerticalUnit::kMetre;
  g.map = {1000, 2000, 25, 0, 0, 12.5};  // 25 m between inlines, 12.5 m between crosslines
  return g;
}

survey::LatticePoint lattice(double i, double j, double k) {
  const auto whole = [](double at) {
    return static_cast<std::int32_t>(std::lround(at * survey::kLatticePerVoxel));
  };
  return {whole(i), whole(j), whole(k)};
}

// The fault i = 10: its chart lies along j and k.
pillars::Chart upright() {
  pillars::Chart chart;
  chart.normal = {1, 0, 0};
  chart.strike = {0, 1, 0};
  chart.dip = {0, 0, 1};
  chart.origin = {10, 0, 0};
  return chart;
}

// How far inside the triangle the point lies, in the units of the chart; negative outside. Plain geometry:
// the least distance to the three lines through its edges, on the side of the third corner.
double depth_inside(const std::array<pillars::ChartPoint, 3>& t, double x, double y) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < 3; ++c) {
    const auto& a = t[c];
    const auto& b = t[(c + 1) % 3];
    const auto& across = t[(c + 2) % 3];
    const double nx = -(b.dip - a.dip), ny = b.strike - a.strike;
    const double length = std::hypot(nx, ny);
    if (length == 0) return -std::numeric_limits<double>::infinity();
    const double side = (across.strike - a.strike) * nx + (across.dip - a.dip) * ny;
    const double at = (x - a.strike) * nx + (y - a.dip) * ny;
    least = std::min(least, (side >= 0 ? at : -at) / length);
  }
  return least;
}

TEST(ChartRaster, EveryCellHasTheFirstFaceThatHoldsItsCentre) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> along(0, 25), thick(-2, 2);
  for (int round = 0; round < 20; ++round) {
    std::vector<survey::LatticeTriangle> triangles;
    for (int n = 0; n < 30; ++n) {
      survey::LatticeTriangle triangle;
      for (survey::LatticePoint& corner : triangle)
        corner = lattice(10 + thick(random), along(random), along(random));
      triangles.push_back(triangle);
    }
    const std::array<std::span<const survey::LatticeTriangle>, 1> all{triangles};
    const ChartRaster raster = raster_over(upright(), all, 0.75);
    const auto faces = covering_faces(raster, triangles, {});
    ASSERT_EQ(faces.size(), raster.cells());
    constexpr double kMargin = 1e-9;
    for (std::int64_t row = 0; row < raster.rows; ++row) {
      for (std::int64_t column = 0; column < raster.columns; ++column) {
        const double x = raster.strike0 + static_cast<double>(column) * raster.cell;
        const double y = raster.dip0 + static_cast<double>(row) * raster.cell;
        const int found = faces[static_cast<std::size_t>(row * raster.columns + column)];
        for (int f = 0; f < static_cast<int>(triangles.size()); ++f) {
          std::array<pillars::ChartPoint, 3> corners;
          for (std::size_t c = 0; c < 3; ++c) {
            corners[c] =
                raster.chart.from_index(survey::Lattice::index_of(triangles[static_cast<std::size_t>(f)][c]));
          }
          const double inside = depth_inside(corners, x, y);
          if (f == found) {
            EXPECT_GE(inside, -kMargin) << row << ' ' << column;
          } else if (found < 0 || f < found) {
            EXPECT_LE(inside, kMargin) << row << ' ' << column << ": an earlier face holds it";
          }
        }
      }
    }
  }
}

TEST(ChartRaster, LeavesNoHoleBetweenNeighbours) {
  // A fan of triangles about a point, whose edges run through many centres.
  std::vector<survey::LatticeTriangle> fan;
  const std::array<std::array<double, 2>, 8> rim{
      {{20, 0}, {20, 20}, {0, 20}, {-20, 20}, {-20, 0}, {-20, -20}, {0, -20}, {20, -20}}};
  for (std::size_t n = 0; n < rim.size(); ++n) {
    const auto& a = rim[n];
    const auto& b = rim[(n + 1) % rim.size()];
    fan.push_back(
        {lattice(10, 30, 30), lattice(10, 30 + a[0], 30 + a[1]), lattice(10, 30 + b[0], 30 + b[1])});
  }
  const std::array<std::span<const survey::LatticeTriangle>, 1> all{fan};
  const ChartRaster raster = raster_over(upright(), all, 1);
  EXPECT_EQ(raster.columns, 41);
  EXPECT_EQ(raster.rows, 41);
  for (const std::int32_t face : covering_faces(raster, fan, {})) EXPECT_GE(face, 0);
}

TEST(ChartRaster, GrowsItsCellsRatherThanTheirNumber) {
  const std::vector<survey::LatticeTriangle> one{
      {lattice(10, 0, 0), lattice(10, 1000, 0), lattice(10, 1000, 1000)}};
  const std::array<std::span<const survey::LatticeTriangle>, 1> all{one};
  const ChartRaster raster = raster_over(upright(), all, 1, 10000);
  EXPECT_LE(raster.columns * raster.rows, 10000);
  EXPECT_EQ(raster.cell, 16);
}

class CompareRuns : public ::testing::Test {
 protected:
  CompareRuns() : project_(project::Project::create(folder_ / "p.footwall", metre_survey())) {
    project_.edit("add", [&](project::Interpretation& picks) { fault_ = picks.add_fault("F"); });
    project_.register_statistics(stored_statistics());
  }
  // A sheet of squares in the plane i = 10 from (j0, k0) on, each cut in two, with a value for each triangle.
  std::int64_t add_run(const std::string& name, double j0, double k0, int count, double leg,
                       const std::function<double(double j, double k)>& value) {
    project::FaultRun run;
    run.fault = fault_;
    run.fault_name = "F";
    std::vector<double> values;
    for (int a = 0; a < count; ++a) {
      for (int b = 0; b < count; ++b) {
        const double j = j0 + a * leg, k = k0 + b * leg;
        run.lattice.push_back({lattice(10, j, k), lattice(10, j + leg, k), lattice(10, j, k + leg)});
        run.lattice.push_back(
            {lattice(10, j + leg, k), lattice(10, j + leg, k + leg), lattice(10, j, k + leg)});
        for (int n = 0; n < 2; ++n) {
          run.panels.push_back(1);
          run.numbers.push_back(static_cast<std::int32_t>(run.numbers.size()));
          values.push_back(value(j, k));
        }
      }
    }
    run.statistics["variance"] = values;
    project::RunRecord record;
    record.name = name;
    return project_.add_run(record, std::span(&run, 1));
  }

  ScratchFolder folder_;
  project::Project project_;
  std::int64_t fault_ = 0;
};

TEST_F(CompareRuns, SubtractsWhereBothHaveAFaceAndLeavesTheRestBlank) {
  // A covers j 5..25, B j 15..35 with other triangles; both k 5..25.
  const std::int64_t a = add_run("a", 5, 5, 10, 2, [](double, double) { return 1.0; });
  const std::int64_t b = add_run("b", 15, 5, 4, 5, [](double j, double) { return j >= 25 ? kNone : 4.0; });
  const RunComparison made = compare_runs(project_, {.fault = "F", .run_a = a, .run_b = b}, {});
  EXPECT_EQ(made.raster.cell, 1);
  EXPECT_NEAR(made.metres.strike, made.raster.chart.strike[1] != 0 ? 12.5 : 5, 1e-9);
  EXPECT_EQ(made.velocity, 0);
  std::int64_t seen = 0;
  for (std::int64_t row = 0; row < made.raster.rows; ++row) {
    for (std::int64_t column = 0; column < made.raster.columns; ++column) {
      const auto cell = static_cast<std::size_t>(row * made.raster.columns + column);
      const survey::IndexPoint at =
          made.raster.chart.to_index({made.raster.strike0 + static_cast<double>(column),
                                      made.raster.dip0 + static_cast<double>(row), 0});
      const auto within = [](double x, double low, double high) { return x > low + 1e-6 && x < high - 1e-6; };
      if (!within(at.k, 5, 25)) continue;
      if (within(at.j, 5, 25)) {
        EXPECT_EQ(made.a[cell], 1) << at.j << ' ' << at.k;
      }
      if (within(at.j, 25, 36)) {
        EXPECT_TRUE(std::isnan(made.a[cell])) << at.j;
      }
      if (within(at.j, 15, 25)) {
        EXPECT_EQ(made.difference[cell], 3) << at.j << ' ' << at.k;
        ++seen;
      }
      if (within(at.j, 25, 35) || within(at.j, 0, 15)) {
        EXPECT_TRUE(std::isnan(made.difference[cell])) << at.j;
      }
    }
  }
  EXPECT_GE(seen, 9 * 19);
  EXPECT_EQ(made.mean, 3);
  EXPECT_EQ(made.rms, 3);
  EXPECT_EQ(made.largest, 3);
  EXPECT_GT(made.only_a, 0);
  EXPECT_EQ(made.only_b, 0);  // what B has beyond A has no value

  const auto file = folder_ / "compared.csv";
  write_csv(made, metre_survey(), file);
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "along_m,down_m,x,y,z,a,b,difference");
  std::int64_t lines = 0, blank = 0;
  while (std::getline(in, line)) {
    ++lines;
    blank += line.ends_with(",1,,");
  }
  EXPECT_EQ(lines, made.both + made.only_a);
  EXPECT_EQ(blank, made.only_a);
}

TEST_F(CompareRuns, ARunAgainstItselfHasNoDifference) {
  const std::int64_t a = add_run("a", 5, 5, 10, 2, [](double j, double k) { return j * 100 + k; });
  const RunComparison made = compare_runs(project_, {.fault = "F", .run_a = a, .run_b = a}, {});
  EXPECT_GT(made.both, 300);
  EXPECT_EQ(made.rms, 0);
  EXPECT_EQ(made.only_a + made.only_b, 0);
}

TEST_F(CompareRuns, SaysWhatIsNotThere) {
  const std::int64_t a = add_run("a", 5, 5, 2, 2, [](double, double) { return 1.0; });
  const auto code = [&](const CompareChoice& choice) {
    try {
      compare_runs(project_, choice, {});
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::kInternal;
  };
  EXPECT_EQ(code({.fault = "G", .run_a = a, .run_b = a}), ErrorCode::kNotFound);
  EXPECT_EQ(code({.fault = "F", .run_a = a, .run_b = a + 7}), ErrorCode::kNotFound);
  EXPECT_EQ(code({.fault = "F", .run_a = a, .run_b = a, .statistic = "contrast"}), ErrorCode::kNotFound);
  project::FaultRun none;
  none.fault = fault_ + 1;
  project_.edit("add", [&](project::Interpretation& picks) { none.fault = picks.add_fault("H"); });
  EXPECT_EQ(code({.fault = "H", .run_a = a, .run_b = a}), ErrorCode::kInvalid);
}

}  // namespace
}  // namespace footwall::tasks
