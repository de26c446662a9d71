#include "engine/isosurface/visible/paper/extract_cells.h"

#include <gtest/gtest.h>

#include <map>

#include "engine/isosurface/brick_ranges.h"
#include "storage/base/error.h"
#include "unit/isosurface/sample_volumes.h"

namespace footwall::isosurface {
namespace {

struct Corner {
  Point position;
  Point normal;
  friend bool operator==(const Corner&, const Corner&) = default;
};
using Corners = std::array<Corner, 3>;

Corners corners_of(const Surface& surface, std::size_t t) {
  Corners corners;
  for (std::size_t n = 0; n < 3; ++n) {
    const std::uint32_t v = surface.triangles.data()[t][n];
    corners[n] = {surface.positions.data()[v], surface.normals.data()[v]};
  }
  return corners;
}

// By number; each number once.
std::map<render::PrimitiveId, Corners> numbered(const std::vector<SomeTriangles>& parts) {
  std::map<render::PrimitiveId, Corners> all;
  for (const SomeTriangles& some : parts) {
    EXPECT_TRUE(some.surface.triangles.empty() || some.runs.front().first_triangle == 0);
    for (std::size_t run = 0; run < some.runs.size(); ++run) {
      const std::size_t end =
          run + 1 < some.runs.size() ? some.runs[run + 1].first_triangle : some.surface.triangles.size();
      for (std::size_t t = some.runs[run].first_triangle; t < end; ++t) {
        const auto id =
            some.runs[run].first_id + static_cast<render::PrimitiveId>(t - some.runs[run].first_triangle);
        EXPECT_TRUE(all.emplace(id, corners_of(some.surface, t)).second) << "number " << id << " twice";
      }
    }
  }
  return all;
}

// Boxes of `cell` cells dealt out to parts in turns: the triangles, their order and bits are those of the
// whole.
void expect_whole(const SampleVolume& volume, const survey::Index& cell, int parts) {
  const Field field = volume.field();
  const BrickRanges bricks = brick_ranges(field, 1);
  ExtractCells cells(field, bricks.tables(), 0, 2);
  std::vector<std::vector<survey::Box>> boxes(static_cast<std::size_t>(parts));
  std::size_t turn = 0;
  for (std::int64_t i = 0; i < volume.size[0] - 1; i += cell[0]) {
    for (std::int64_t j = 0; j < volume.size[1] - 1; j += cell[1]) {
      for (std::int64_t k = 0; k < volume.size[2] - 1; k += cell[2]) {
        survey::Box box{{i, j, k}, {i + cell[0], j + cell[1], k + cell[2]}};
        for (int axis = 0; axis < 3; ++axis) box.hi[axis] = std::min(box.hi[axis], volume.size[axis] - 1);
        boxes[turn++ * 7 % 11 % boxes.size()].push_back(box);
      }
    }
  }
  std::vector<SomeTriangles> some;
  for (const std::vector<survey::Box>& part : boxes) {
    SomeTriangles used;  // whatever was in it
    cells.extract(boxes.front(), used);
    cells.extract(part, used);
    some.push_back(std::move(used));
  }
  const std::map<render::PrimitiveId, Corners> got = numbered(some);
  Surface whole;
  extract(field, 0, {}, whole);
  ASSERT_EQ(got.size(), whole.triangles.size());
  std::size_t t = 0;
  for (const auto& [id, corners] : got)
    ASSERT_TRUE(corners == corners_of(whole, t++)) << "triangle " << t - 1;
}

TEST(ExtractCells, PartsAreTheWholeInItsOrder) {
  for (const double nulls : {0.0, 0.1}) {
    const SampleVolume noise = random_volume({27, 20, 35}, 4, nulls);
    for (const int parts : {1, 2, 5}) {
      expect_whole(noise, {8, 8, 8}, parts);
      expect_whole(noise, {16, 8, 24}, parts);
      expect_whole(noise, {4, 4, 4}, parts);
      expect_whole(noise, {5, 7, 12}, parts);
      if (HasFatalFailure()) return;
    }
  }
  expect_whole(ball_volume({40, 41, 42}, 12), {3, 3, 12}, 3);
  // Values at the isovalue: vertices beside the borders of cells.
  expect_whole(sampled({20, 20, 20}, [](auto i, auto j, auto k) { return (i * 7 + j * 5 + k * 3) % 4 - 1; }),
               {8, 8, 8}, 3);
}

TEST(ExtractCells, TakesNoBoxesAndFlatVolumes) {
  const SampleVolume flat = random_volume({9, 1, 9}, 1);
  const BrickRanges bricks = brick_ranges(flat.field(), 1);
  ExtractCells cells(flat.field(), bricks.tables(), 0, 1);
  SomeTriangles some;
  cells.extract({}, some);
  EXPECT_TRUE(some.surface.triangles.empty());
  const survey::Box none{{0, 0, 0}, {8, 0, 8}};
  cells.extract(std::span(&none, 1), some);
  EXPECT_TRUE(some.surface.triangles.empty());
}

TEST(ExtractCells, RefusesPartsOfVolumesAndForeignTables) {
  const SampleVolume volume = random_volume({20, 20, 20}, 1);
  const BrickRanges bricks = brick_ranges(volume.field(), 1);
  Field part = volume.field();
  part.volume_size = {40, 20, 20};
  EXPECT_THROW(ExtractCells(part, bricks.tables(), 0, 1), Error);
  const SampleVolume other = random_volume({20, 20, 30}, 1);
  EXPECT_THROW(ExtractCells(other.field(), bricks.tables(), 0, 1), Error);
}

}  // namespace
}  // namespace footwall::isosurface
