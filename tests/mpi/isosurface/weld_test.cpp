#include "engine/isosurface/parallel/weld.h"

#include "engine/isosurface/canonical.h"
#include "mpi/isosurface/mesh_case.h"
#include "rounds.h"

namespace footwall::isosurface {
namespace {

using Weld = MeshCase;

// Also the numbers of vertices and triangles are those of the serial kernel.
TEST_F(Weld, IsTheSurfaceOfTheWholeVolumeBitForBit) {
  std::uint64_t seed = 1;
  for (const Shape& shape : shapes()) {
    for (const double nulls : {0.0, 0.03, 0.4}) {
      const TestVolume volume{shape.dims, rough(++seed, nulls)};
      const Pillars pillars(shape.dims, world.size(), shape.interleaving);
      const Surface whole = gathered(welded(volume, pillars, with_keys()));
      if (world.rank() != 0) continue;
      EXPECT_EQ(difference(whole, serial(volume), shape.dims), std::nullopt)
          << shape.dims[0] << "x" << shape.dims[1] << " nulls " << nulls;
    }
  }
}

TEST_F(Weld, RandomDecompositionsOfRandomVolumesGiveTheSame) {
  SplitMix64 random(17);
  const auto below = [&](int n) { return static_cast<int>(random.next() % static_cast<std::uint64_t>(n)); };
  const int times = rounds(12);
  for (int round = 0; round < times; ++round) {
    const survey::Index dims{1 + below(20), 1 + below(20), 1 + below(30)};
    const Interleaving interleaving{1 + below(5), 1 + below(5), 1 + below(4)};
    const TestVolume volume{dims, rough(random.next(), below(2) == 0 ? 0.0 : 0.1)};
    ParallelOptions options = with_keys();
    options.normals = below(3) != 0;
    options.block_cells = below(2) == 0 ? 500 : 1 << 20;
    const Pillars pillars(dims, world.size(), interleaving);
    const Surface whole = gathered(welded(volume, pillars, options), options.normals);
    if (world.rank() != 0) continue;
    Surface expected = serial(volume);
    if (!options.normals) expected.normals.release();
    EXPECT_EQ(difference(whole, expected, dims), std::nullopt) << "round " << round;
  }
}

TEST_F(Weld, WhatIsComputedMoreThanOnceIsCounted) {
  const TestVolume volume{{25, 25, 25}, rough(5, 0)};
  std::int64_t before = 0;
  for (const Interleaving& interleaving :
       {Interleaving{1, 1, 1}, Interleaving{2, 2, 1}, Interleaving{4, 4, 2}}) {
    const Pillars pillars(volume.dims, world.size(), interleaving);
    const MeshPart part = welded(volume, pillars, with_keys());
    const std::int64_t repeated =
        world.sum(static_cast<std::int64_t>(part.computed)) - static_cast<std::int64_t>(part.all_vertices);
    if (world.size() == 1 && interleaving == Interleaving{1, 1, 1}) {
      EXPECT_EQ(repeated, 0);
    } else {
      EXPECT_GT(repeated, before);
    }
    before = repeated;
  }
}

}  // namespace
}  // namespace footwall::isosurface
