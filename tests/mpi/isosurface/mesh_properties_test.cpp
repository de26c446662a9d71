#include "engine/isosurface/parallel/mesh_properties.h"

#include "engine/isosurface/canonical.h"
#include "engine/isosurface/cap.h"
#include "mpi/isosurface/mesh_case.h"

namespace footwall::isosurface {
namespace {

using PropertiesOverRanks = MeshCase;

Measure measure() {
  return Measure::of_spacing(12.5, 25, 4);
}

Surface serial_capped(const TestVolume& volume, bool capped) {
  Surface surface = serial(volume);
  std::vector<float> room;
  if (capped) cap(volume.whole(room), kIsovalue, surface);
  return surface;
}

TEST_F(PropertiesOverRanks, AreThoseOfTheMeshInOnePiece) {
  std::uint64_t seed = 40;
  for (const Shape& shape : shapes()) {
    for (const bool capped : {false, true}) {
      const TestVolume volume{shape.dims, rough(++seed, seed % 3 == 0 ? 0.1 : 0)};
      const Pillars pillars(shape.dims, world.size(), shape.interleaving);
      ParallelOptions options = with_keys();
      options.cap = capped;
      const MeshPart part = welded(volume, pillars, options);
      const MeshProperties found = mesh_properties(world, part, measure());
      if (world.rank() != 0) continue;
      const Properties expected = properties_of(serial_capped(volume, capped), measure());
      const Properties& p = found.properties;
      EXPECT_EQ(p.vertices, expected.vertices);
      EXPECT_EQ(p.edges, expected.edges);
      EXPECT_EQ(p.triangles, expected.triangles);
      EXPECT_EQ(p.euler, expected.euler);
      EXPECT_EQ(p.genus, expected.genus);
      EXPECT_EQ(p.closed_components, expected.closed_components);
      EXPECT_EQ(p.components.size(), expected.components.size());
      EXPECT_EQ(p.boundary_edges.inside, expected.boundary_edges.inside + expected.boundary_edges.at_nulls);
      EXPECT_EQ(p.boundary_edges.at_border, expected.boundary_edges.at_border);
      EXPECT_EQ(p.non_manifold_edges, expected.non_manifold_edges);
      EXPECT_EQ(p.area, expected.area);  // to the last bit
      EXPECT_EQ(p.volume, expected.volume);
    }
  }
}

TEST_F(PropertiesOverRanks, TheFilterKeepsWhatTheSerialOneKeeps) {
  const TestVolume volume{{24, 21, 26}, rough(8, 0.05)};
  const Surface surface = serial(volume);
  const Components components = components_of(surface);
  const std::vector<ComponentTally> tallies = tallies_of(surface, components, measure());
  for (const ComponentFilter& filter :
       {ComponentFilter{1, 0}, ComponentFilter{3, 0}, ComponentFilter{0, 500}}) {
    const Pillars pillars(volume.dims, world.size(), {2, 3, 2});
    const MeshPart part = welded(volume, pillars, with_keys());
    const MeshProperties found = mesh_properties(world, part, measure());
    const Surface left = gathered(keep_components(world, part, found, measure(), filter));
    if (world.rank() != 0) continue;
    const Surface expected = keep(surface, components, kept(tallies, measure(), filter));
    EXPECT_GT(expected.triangles.size(), 0U);
    EXPECT_LT(expected.triangles.size(), surface.triangles.size());
    EXPECT_EQ(difference(left, expected, volume.dims), std::nullopt);
  }
}

// What a cap adds stands at the end, in an order that does not depend on the ranks either.
TEST_F(PropertiesOverRanks, CapsAreThoseOfTheWholeButForOrder) {
  for (const Shape& shape : shapes()) {
    const TestVolume volume{shape.dims, rough(91, 0)};
    ParallelOptions options = with_keys();
    options.cap = true;
    const Surface whole =
        gathered(welded(volume, Pillars(shape.dims, world.size(), shape.interleaving), options));
    if (world.rank() != 0) continue;
    const Surface expected = serial_capped(volume, true);
    EXPECT_EQ(difference_but_for_order(whole, expected, shape.dims), std::nullopt);
  }
}

}  // namespace
}  // namespace footwall::isosurface
