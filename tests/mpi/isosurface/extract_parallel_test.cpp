#include "engine/isosurface/parallel/extract_parallel.h"

#include "engine/isosurface/canonical.h"
#include "mpi/isosurface/mesh_case.h"

namespace footwall::isosurface {
namespace {

using ExtractParallel = MeshCase;

// A ball in a corner: most bricks hold nothing.
TestVolume ball() {
  return {{60, 50, 40}, [](const survey::Index& p) {
            const auto square = [](std::int64_t n) { return static_cast<float>(n * n); };
            return 81.5F - square(p[0] - 12) - square(p[1] - 13) - square(p[2] - 14);
          }};
}

TEST_F(ExtractParallel, RowsAreNumberedAsInTheWhole) {
  const TestVolume volume{{19, 16, 30}, rough(3, 0.02)};
  const Surface whole = serial(volume);
  const Pillars pillars(volume.dims, world.size(), {2, 2, 2});
  ParallelOptions options = with_keys();
  options.block_cells = 900;
  const Extraction extraction = extracted(volume, pillars, options);
  EXPECT_EQ(extraction.triangles, whole.triangles.size());
  std::int64_t triangles = 0;
  for (const Piece& piece : extraction.pieces) {
    const Surface& surface = piece.surface;
    std::size_t row = 0;
    for (std::int64_t i = surface.cells.lo[0]; i < surface.cells.hi[0]; ++i) {
      for (std::int64_t j = surface.cells.lo[1]; j < surface.cells.hi[1]; ++j, ++row) {
        for (std::uint64_t t = surface.row_first[row]; t < surface.row_first[row + 1]; ++t, ++triangles) {
          const std::uint64_t number = piece.row_numbers[row] + t - surface.row_first[row];
          for (int corner = 0; corner < 3; ++corner) {
            ASSERT_EQ(surface.keys[surface.triangles[t][corner]],
                      whole.keys[whole.triangles[number][corner]]);
          }
        }
      }
    }
  }
  EXPECT_EQ(world.sum(triangles), static_cast<std::int64_t>(whole.triangles.size()));
}

TEST_F(ExtractParallel, OnlyWhatThePyramidNamesIsRead) {
  const TestVolume volume = ball();
  const TestBricks pyramid(volume);
  const Surface expected = serial(volume);
  for (const Interleaving& interleaving : {Interleaving{1, 1, 1}, Interleaving{3, 2, 2}}) {
    const Pillars pillars(volume.dims, world.size(), interleaving);
    ParallelOptions options = with_keys();
    options.bricks = &pyramid.bricks;
    options.kernel_skips = false;  // the plane kernel cannot
    Extraction extraction = extracted(volume, pillars, options);
    EXPECT_LT(world.sum(extraction.samples_read), volume.dims[0] * volume.dims[1] * volume.dims[2] / 2);
    const Surface whole = gathered(weld(world, pillars, true, extraction.pieces));
    if (world.rank() == 0) {
      EXPECT_EQ(difference(whole, expected, volume.dims), std::nullopt);
    }
  }
}

TEST_F(ExtractParallel, NothingIsReadForAValueThatNoSampleHas) {
  const TestVolume volume = ball();
  const TestBricks pyramid(volume);
  const Pillars pillars(volume.dims, world.size(), {2, 2, 1});
  ParallelOptions options = with_keys();
  options.bricks = &pyramid.bricks;
  Extraction extraction;
  const FieldOf never = [](const survey::Box&) -> Field { throw Error(ErrorCode::kInternal, "was read"); };
  extract_parallel(world, pillars, never, 1000, options, {}, extraction);
  EXPECT_EQ(extraction.triangles, 0U);
  const MeshPart part = weld(world, pillars, true, extraction.pieces);
  EXPECT_EQ(part.all_vertices, 0U);
}

TEST_F(ExtractParallel, AFailureOfOneRankIsTheSameErrorOnAll) {
  const TestVolume volume = ball();
  const Pillars pillars(volume.dims, world.size(), {2, 1, 1});
  std::vector<float> room;
  const FieldOf good = field_of(volume, room);
  const FieldOf bad = [&](const survey::Box& box) {
    if (world.rank() == world.size() - 1) throw Error(ErrorCode::kCorrupt, "a chunk was altered");
    return good(box);
  };
  Extraction extraction;
  try {
    extract_parallel(world, pillars, bad, kIsovalue, with_keys(), {}, extraction);
    FAIL();
  } catch (const comm::AgreedError& error) {
    EXPECT_EQ(error.code(), ErrorCode::kCorrupt);
  }
  const JobContext cancelled;
  if (world.rank() == 0) cancelled.cancel();
  try {
    extract_parallel(world, pillars, good, kIsovalue, with_keys(), cancelled, extraction);
    FAIL();
  } catch (const comm::AgreedError& error) {
    EXPECT_EQ(error.code(), ErrorCode::kCancelled);
  }
}

TEST_F(ExtractParallel, ImbalanceIsTheShareOfTimeSpentWaiting) {
  // One rank works twice as long as the others.
  const double busy = world.rank() == 0 ? 2 : 1;
  const double mean = (2.0 + world.size() - 1) / world.size();
  EXPECT_DOUBLE_EQ(load_imbalance(world, busy), 1 - mean / 2);
  EXPECT_EQ(load_imbalance(world, 0), 0);
}

}  // namespace
}  // namespace footwall::isosurface
