#include "engine/isosurface/bricks.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "engine/isosurface/brick_ranges.h"
#include "engine/verify/surface_by_definition.h"
#include "engine/voxelize/simd.h"
#include "sample_volumes.h"
#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

using survey::Box;
using survey::Index;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

SampleVolume waves(const Index& size) {
  return sampled(size, [](auto i, auto j, auto k) {
    return static_cast<float>(i * i + 3 * j * j - 2 * j * k + k * k % 97) / 64;
  });
}

void expect_defined(const Field& field, float isovalue, ExtractOptions options, const std::string& what) {
  const Surface defined = verify::surface_by_definition(field, isovalue, options);
  Surface made;
  options.keys = true;
  extract(field, isovalue, options, made);
  EXPECT_EQ(verify::difference(made, defined), "") << what;
  EXPECT_EQ(verify::unsoundness(made), "") << what;
}

class Bricks : public testing::Test {
 protected:
  void TearDown() override { voxelize::limit_simd(forced_simd()); }
};

TEST_F(Bricks, EqualTheDefinitionForAnyRowLength) {
  const Index sizes[] = {{2, 2, 2},   {3, 2, 63},  {2, 3, 64}, {3, 3, 65}, {2, 4, 127},
                         {3, 2, 128}, {4, 3, 129}, {9, 5, 17}, {5, 18, 3}};
  for (const Index& size : sizes) {
    for (const double nulls : {0.0, 0.01, 0.5}) {
      const SampleVolume volume = random_volume(size, 7, nulls);
      expect_defined(volume.field(), 0.1F, {},
                     fmt::format("{}x{}x{}, {} nulls", size[0], size[1], size[2], nulls));
    }
    expect_defined(waves(size).field(), 3, {}, fmt::format("waves {}x{}x{}", size[0], size[1], size[2]));
  }
}

TEST_F(Bricks, OfAVolumeWithoutCellsAreEmpty) {
  for (const Index& size : {Index{1, 9, 5}, Index{7, 1, 5}, Index{3, 4, 1}, Index{1, 1, 1}}) {
    const SampleVolume volume = random_volume(size, 1);
    expect_defined(volume.field(), 0, {}, "no cells");
  }
  ExtractOptions options;
  options.cells = Box{{2, 2, 2}, {2, 3, 4}};
  const SampleVolume volume = random_volume({5, 5, 5}, 1);
  expect_defined(volume.field(), 0, options, "an empty box");
}

TEST_F(Bricks, AreTheSameOnAllInstructionSetsAndThreadCounts) {
  const SampleVolume volumes[] = {random_volume({14, 11, 70}, 3), random_volume({14, 11, 70}, 4, 0.02),
                                  waves({20, 13, 66})};
  for (const auto level : {SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    voxelize::limit_simd(level);
    for (int threads = 1; threads <= 3; ++threads) {
      for (const SampleVolume& volume : volumes) {
        ExtractOptions options;
        options.threads = threads;
        expect_defined(volume.field(), 0.2F, options, fmt::format("{}, {} threads", name_of(level), threads));
      }
    }
  }
}

TEST_F(Bricks, TakeValuesEqualToTheIsovalueForInside) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> value(0, 3);
  const SampleVolume whole = sampled({9, 9, 67}, [&](auto...) { return static_cast<float>(value(random)); });
  for (const float isovalue : {0.0F, 1.0F, 2.0F, 3.0F, 4.0F})
    expect_defined(whole.field(), isovalue, {}, "whole");
  const SampleVolume constant = sampled({4, 4, 4}, [](auto...) { return 2.0F; });
  for (const float isovalue : {1.0F, 2.0F, 3.0F}) {
    Surface made;
    extract(constant.field(), isovalue, {}, made);
    EXPECT_EQ(made.triangles.size(), 0U);
    EXPECT_EQ(made.positions.size(), 0U);
    EXPECT_EQ(made.row_first, std::vector<std::uint64_t>(10, 0));
  }
}

TEST_F(Bricks, StandInfiniteHugeAndTinyValues) {
  std::mt19937 random(6);
  const float values[] = {kInf, -kInf, 3e38F, -3e38F, 1e-40F, -1e-40F, 0, 1, -1, 1e-25F, -2e-25F, 1e19F};
  std::uniform_int_distribution<std::size_t> which(0, std::size(values) - 1);
  for (int round = 0; round < 5; ++round) {
    const SampleVolume volume = sampled({7, 8, 20}, [&](auto...) { return values[which(random)]; });
    for (const float isovalue : {0.0F, 1e-25F, 1e20F}) {
      Surface made;
      extract(volume.field(), isovalue, {}, made);
      EXPECT_EQ(verify::difference(made, verify::surface_by_definition(volume.field(), isovalue, {})), "");
    }
  }
  // Tiny values have directions, too.
  const SampleVolume slope =
      sampled({4, 4, 4}, [](auto i, auto j, auto) { return 1e-30F * static_cast<float>(i + j); });
  Surface made;
  extract(slope.field(), 2.5e-30F, {}, made);
  ASSERT_GT(made.normals.size(), 0U);
  for (const Point& normal : made.normals.all()) {
    EXPECT_NEAR(normal.i, -std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(normal.k, 0, 1e-6);
  }
}

TEST_F(Bricks, LeaveOutNormalsAndKeysThatAreNotAskedFor) {
  const SampleVolume volume = random_volume({6, 6, 66}, 8);
  ExtractOptions options;
  Surface made;
  for (const bool normals : {true, false}) {
    for (const bool keys : {true, false}) {
      options.normals = normals;
      options.keys = keys;
      extract(volume.field(), 0, options, made);
      EXPECT_EQ(made.normals.size(), normals ? made.positions.size() : 0);
      EXPECT_EQ(made.keys.size(), keys ? made.positions.size() : 0);
      EXPECT_EQ(verify::difference(made, verify::surface_by_definition(volume.field(), 0, options)), "");
    }
  }
}

TEST_F(Bricks, OfABoxOfCellsUseTheSamplesAroundIt) {
  for (const SampleVolume& volume :
       {random_volume({12, 13, 140}, 9), random_volume({12, 13, 140}, 9, 0.01), waves({12, 13, 140})}) {
    for (const Box& box : {Box{{0, 0, 0}, {5, 12, 139}}, Box{{3, 4, 63}, {7, 9, 65}},
                           Box{{10, 0, 1}, {11, 3, 128}}, Box{{2, 2, 64}, {3, 3, 65}}}) {
      ExtractOptions options;
      options.cells = box;
      options.threads = 2;
      expect_defined(volume.field(), 0.1F, options, "a box");
    }
  }
}

TEST_F(Bricks, OfAPartWithAHaloAreThoseOfTheWhole) {
  const SampleVolume volume = random_volume({15, 16, 90}, 10, 0.003);
  for (const Box& cells :
       {Box{{4, 5, 20}, {9, 11, 75}}, Box{{0, 0, 0}, {3, 15, 89}}, Box{{13, 9, 60}, {14, 15, 89}}}) {
    ExtractOptions options;
    options.cells = cells;
    options.keys = true;
    const Surface whole = verify::surface_by_definition(volume.field(), 0.05F, options);
    // Samples of the cells' corners, and one more for central differences.
    Box samples = survey::grown(cells, 1);
    for (int axis = 0; axis < 3; ++axis) samples.hi[axis] += 1;
    const SamplePart part = part_of(volume, survey::intersection(samples, {{0, 0, 0}, volume.size}));
    Surface made;
    extract(part.field, 0.05F, options, made);
    EXPECT_EQ(verify::difference(made, whole), "");
  }
}

TEST_F(Bricks, AreSkippedWithoutAChange) {
  const auto ball = [](auto i, auto j, auto k) {
    return 12.3F - static_cast<float>(std::hypot(static_cast<double>(i) - 13, static_cast<double>(j) - 20,
                                                 static_cast<double>(k) - 100));
  };
  SampleVolume nulls = sampled({33, 40, 150}, ball);
  for (std::size_t n = 0; n < nulls.values.size(); n += 991) nulls.values[n] = kNan;
  for (const SampleVolume& volume :
       {sampled({33, 40, 150}, ball), nulls, random_volume({10, 9, 130}, 11, 0.3)}) {
    const BrickRanges ranges = brick_ranges(volume.field(), 2);
    const auto tables = ranges.tables();
    ExtractOptions options;
    options.bricks = &tables;
    expect_defined(volume.field(), 0.5F, options, "the whole");
    options.threads = 3;
    options.cells = Box{{1, 2, 3}, {9, 8, 127}};
    expect_defined(volume.field(), 0.5F, options, "a box");
    const SamplePart part = part_of(volume, {{1, 1, 5}, {10, 9, 128}});
    options.cells = Box{{2, 2, 6}, {8, 8, 126}};
    expect_defined(part.field, 0.5F, options, "a part");
  }
}

TEST_F(Bricks, ThatAreSkippedAreNotRead) {
  // Below the isovalue but for one corner of the volume.
  SampleVolume volume =
      sampled({40, 40, 200}, [](auto i, auto j, auto k) { return i + j + k < 6 ? 1.0F : 0.0F; });
  const BrickRanges ranges = brick_ranges(volume.field(), 1);
  const auto tables = ranges.tables();
  ExtractOptions options;
  options.bricks = &tables;
  const Surface defined = verify::surface_by_definition(volume.field(), 0.5F, options);
  ASSERT_GT(defined.triangles.size(), 0U);
  for (std::int64_t i = 0; i < 40; ++i) {
    for (std::int64_t j = 0; j < 40; ++j) {
      for (std::int64_t k = 0; k < 200; ++k) {
        if (i > 9 || j > 9 || k > 9) volume.values[static_cast<std::size_t>((i * 40 + j) * 200 + k)] = 7;
      }
    }
  }
  Surface made;
  extract(volume.field(), 0.5F, options, made);
  EXPECT_EQ(verify::difference(made, defined), "");
}

TEST_F(Bricks, RefuseWhatDoesNotFit) {
  const SampleVolume volume = random_volume({4, 4, 4}, 12);
  Surface made;
  const auto code_of = [&](const Field& field, float isovalue, const ExtractOptions& options) {
    try {
      extract(field, isovalue, options, made);
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::kInternal;
  };
  Field field = volume.field();
  for (const float isovalue : {kNan, kInf, -kInf})
    EXPECT_EQ(code_of(field, isovalue, {}), ErrorCode::kInvalid);
  ExtractOptions options;
  options.cells = Box{{0, 0, 0}, {4, 3, 3}};
  EXPECT_EQ(code_of(field, 0, options), ErrorCode::kInvalid);
  options = {};
  options.threads = 0;
  EXPECT_EQ(code_of(field, 0, options), ErrorCode::kInvalid);
  BrickRanges ranges = brick_ranges(field, 1);
  ranges.dims = {2, 1, 1};
  const auto tables = ranges.tables();
  options = {};
  options.bricks = &tables;
  EXPECT_EQ(code_of(field, 0, options), ErrorCode::kInvalid);
  field.size = {4, 4, 5};
  EXPECT_EQ(code_of(field, 0, {}), ErrorCode::kInvalid);
  field = volume.field();
  field.origin = {1, 0, 0};
  EXPECT_EQ(code_of(field, 0, {}), ErrorCode::kInvalid);
}

// The surface of parts is put together from those of single cells, in the order of cells.
TEST(BrickParts, GiveTheWholeSurfacesTriangles) {
  const Index size{20, 18, 27};
  for (const double null_share : {0.0, 0.01}) {
    const SampleVolume volume = random_volume(size, 11, null_share);
    const BrickRanges ranges = brick_ranges(volume.field(), 1);
    const isosurface::Bricks bricks = ranges.tables();
    std::mt19937_64 random(3);
    std::vector<BrickParts> parts(ranges.min.size());
    for (BrickParts& word : parts) word = random() % 5 == 0 ? 0 : random() & random();
    Surface whole;
    extract(volume.field(), 0.1F, {}, whole);

    std::vector<Point> corners;  // three a triangle, each a place and a normal
    std::vector<PartRun> runs;
    for (std::int64_t i = 0; i + 1 < size[0]; ++i) {
      for (std::int64_t j = 0; j + 1 < size[1]; ++j) {
        std::int64_t part = -1;
        for (std::int64_t k = 0; k + 1 < size[2]; ++k) {
          const auto word =
              static_cast<std::size_t>((i / 8 * bricks.dims[1] + j / 8) * bricks.dims[2] + k / 8);
          if ((parts[word] >> (16 * (i % 8 / 2) + 4 * (j % 8 / 2) + k % 8 / 2) & 1U) == 0) continue;
          ExtractOptions one;
          one.cells = Box{{i, j, k}, {i + 1, j + 1, k + 1}};
          Surface cell;
          extract(volume.field(), 0.1F, one, cell);
          if (cell.triangles.empty()) continue;
          if (k / 2 != part) runs.push_back({corners.size() / 6, i, j, k / 2});
          part = k / 2;
          for (const Triangle& triangle : cell.triangles.all()) {
            for (const std::uint32_t v : triangle) {
              corners.push_back(cell.positions[v]);
              corners.push_back(cell.normals[v]);
            }
          }
        }
      }
    }
    for (int threads = 1; threads <= 3; ++threads) {
      ExtractOptions options;
      options.threads = threads;
      options.bricks = &bricks;
      options.parts = parts;
      std::vector<PartRun> listed;
      options.part_runs = &listed;
      Surface made;
      extract(volume.field(), 0.1F, options, made);
      ASSERT_EQ(made.triangles.size(), corners.size() / 6);
      EXPECT_LT(made.triangles.size(), whole.triangles.size());
      std::size_t at = 0;
      for (const Triangle& triangle : made.triangles.all()) {
        for (const std::uint32_t v : triangle) {
          ASSERT_EQ(made.positions[v], corners[at++]);
          ASSERT_EQ(made.normals[v], corners[at++]);
        }
      }
      ASSERT_EQ(listed.size(), runs.size());
      for (std::size_t n = 0; n < runs.size(); ++n) {
        ASSERT_EQ(listed[n].first_triangle, runs[n].first_triangle);
        ASSERT_EQ(listed[n].i, runs[n].i);
        ASSERT_EQ(listed[n].j, runs[n].j);
        ASSERT_EQ(listed[n].part, runs[n].part);
      }
    }
    ExtractOptions wrong;
    wrong.parts = parts;
    EXPECT_THROW(extract(volume.field(), 0.1F, wrong, whole), Error);
    wrong.bricks = &bricks;
    wrong.parts = std::span(parts).first(3);
    EXPECT_THROW(extract(volume.field(), 0.1F, wrong, whole), Error);
  }
}

}  // namespace
}  // namespace footwall::isosurface
