// What ranks extracted of a surface becomes the same mesh, whoever extracted what.
#include "engine/session/visible_mesh.h"

#include <gtest/gtest.h>

#include <deque>
#include <random>

#include "engine/isosurface/extract.h"
#include "unit/isosurface/sample_volumes.h"

namespace footwall::session {
namespace {

using isosurface::Surface;

// Some triangles of a surface with their numbers, in a copy of all its vertices.
struct Share {
  std::vector<render::Vec3f> positions;
  std::vector<render::Vec3f> normals;
  std::vector<render::TriangleIndices> triangles;
  std::vector<render::IdRun> runs;

  render::LitSurface lit() const { return {0, {}, positions, normals, triangles, runs}; }
};

// What the `mine`-th of `shares` holds, where each triangle is given to one at random.
Share share_of(const Surface& surface, unsigned seed, int shares, int mine) {
  Share share;
  for (std::size_t v = 0; v < surface.positions.size(); ++v) {
    const isosurface::Point& p = surface.positions[v];
    const isosurface::Point& n = surface.normals[v];
    share.positions.push_back({p.i, p.j, p.k});
    share.normals.push_back({n.i, n.j, n.k});
  }
  std::mt19937 random(seed);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (static_cast<int>(random() % static_cast<unsigned>(shares)) != mine) continue;
    share.runs.push_back({share.triangles.size(), static_cast<render::PrimitiveId>(7 + 3 * t)});
    const isosurface::Triangle& from = surface.triangles[t];
    share.triangles.push_back({static_cast<std::int32_t>(from[0]), static_cast<std::int32_t>(from[1]),
                               static_cast<std::int32_t>(from[2])});
  }
  return share;
}

// The corners of every triangle, which is what a mesh is but for the numbers of its vertices.
std::vector<isosurface::Point> corners_of(const Surface& surface) {
  std::vector<isosurface::Point> corners;
  for (const isosurface::Triangle& triangle : surface.triangles.all()) {
    for (const std::uint32_t vertex : triangle) {
      corners.push_back(surface.positions[vertex]);
      corners.push_back(surface.normals[vertex]);
    }
  }
  return corners;
}

TEST(VisibleMesh, IsTheSurfaceWhoeverExtractedItsTriangles) {
  comm::Communicator world(MPI_COMM_WORLD);
  const isosurface::SampleVolume volume = isosurface::random_volume({9, 8, 10}, 5, 0.05);
  Surface whole;
  isosurface::extract(volume.field(), 0, {}, whole);
  ASSERT_GT(whole.triangles.size(), 500U);
  for (unsigned seed = 1; seed < 4; ++seed) {
    // Two surfaces on each rank; what belongs to nobody is not seen.
    const int shares = 2 * world.size() + (seed == 3 ? 2 : 0);
    std::deque<Share> kept;
    std::vector<render::LitSurface> mine;
    for (int n = 0; n < 2; ++n)
      mine.push_back(kept.emplace_back(share_of(whole, seed, shares, 2 * world.rank() + n)).lit());
    const isosurface::MeshPart mesh = visible_mesh(world, volume.size, mine);
    std::size_t triangles = 0;
    for (const render::LitSurface& some : mine) triangles += some.triangles.size();
    EXPECT_EQ(mesh.all_triangles,
              static_cast<std::uint64_t>(world.sum(static_cast<std::int64_t>(triangles))));
    if (world.rank() != 0) {
      EXPECT_EQ(mesh.own, 0U);
      continue;
    }
    EXPECT_EQ(mesh.all_vertices, mesh.mesh.positions.size());
    if (seed == 3) {
      EXPECT_LT(mesh.all_triangles, whole.triangles.size());
      EXPECT_LE(mesh.all_vertices, whole.positions.size());
      continue;
    }
    EXPECT_EQ(mesh.all_vertices, whole.positions.size());
    EXPECT_EQ(corners_of(mesh.mesh), corners_of(whole));
  }
}

TEST(VisibleMesh, OfNothingIsEmpty) {
  comm::Communicator world(MPI_COMM_WORLD);
  const isosurface::MeshPart mesh = visible_mesh(world, {4, 4, 4}, {});
  EXPECT_EQ(mesh.all_triangles, 0U);
  EXPECT_EQ(mesh.all_vertices, 0U);
  EXPECT_TRUE(mesh.vertex_runs.empty());
}

}  // namespace
}  // namespace footwall::session
