#include "engine/mesh/surface_facts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "engine/mesh/check.h"
#include "engine/mesh/walk.h"
#include "storage/base/error.h"
#include "unit/mesh/grid.h"

namespace footwall::mesh {
namespace {

using survey::Surface;

Surface surface_of(std::size_t vertices, std::vector<std::array<std::int32_t, 3>> triangles) {
  Surface s;
  s.name = "test";
  for (std::size_t v = 0; v < vertices; ++v)
    s.vertices.push_back({double(v % 3), double(v / 3), double(v * v % 5)});
  s.triangles = std::move(triangles);
  return s;
}

// The pieces hold every face of the surface, unturned, and build a mesh.
void expect_sound(const Surface& s, const CutSurface& cut) {
  ASSERT_EQ(cut.faces.size(), s.triangles.size());
  for (std::size_t f = 0; f < cut.faces.size(); ++f)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(cut.source_vertex[cut.faces[f][k]], s.triangles[f][k]);
  const std::vector<survey::IndexPoint> positions(cut.source_vertex.size());
  const Mesh m(positions, cut.faces);
  EXPECT_TRUE(problems_of(m).empty());
  EXPECT_EQ(static_cast<std::int64_t>(components(m).size()), cut.pieces);
}

TEST(SurfaceFacts, OfASheet) {
  const auto sheet = testing::sheet(3, 4);
  Surface s;
  for (const auto& p : sheet.positions) s.vertices.push_back({p.i * 2, p.j, p.k});
  s.triangles = sheet.faces;
  s.vertices.push_back({0, 0, 0});  // used by no face
  const SurfaceFacts expected{
      .vertices = 21, .faces = 24, .components = 1, .boundary_loops = 1, .euler = 1, .area = 24};
  EXPECT_EQ(surface_facts(s), expected);
  const CutSurface cut = cut_into_manifold(s);
  EXPECT_EQ(cut.faces, s.triangles);
  EXPECT_EQ(cut.copied_vertices + cut.cut_edges, 0);
}

TEST(SurfaceFacts, OfAClosedTetrahedron) {
  const SurfaceFacts f = surface_facts(surface_of(4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}));
  EXPECT_EQ(f.boundary_loops, 0);
  EXPECT_EQ(f.euler, 2);
}

TEST(SurfaceFacts, ThreeFacesAtAnEdge) {
  const Surface s = surface_of(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  const SurfaceFacts f = surface_facts(s);
  EXPECT_EQ(f.nonmanifold_edges, 1);
  EXPECT_EQ(f.bow_tie_vertices, 0);
  EXPECT_EQ(f.inconsistent_edges, 0);
  EXPECT_EQ(f.components, 1);
  const CutSurface cut = cut_into_manifold(s);
  expect_sound(s, cut);
  EXPECT_EQ(cut.pieces, 3);
  EXPECT_EQ(cut.cut_edges, 1);
}

TEST(SurfaceFacts, BowTie) {
  const Surface s = surface_of(5, {{0, 1, 2}, {0, 3, 4}});
  const SurfaceFacts f = surface_facts(s);
  EXPECT_EQ(f.bow_tie_vertices, 1);
  EXPECT_EQ(f.components, 2);
  EXPECT_EQ(f.boundary_loops, 2);
  EXPECT_EQ(f.euler, 1);  // 5 - 6 + 2, as read
  const CutSurface cut = cut_into_manifold(s);
  expect_sound(s, cut);
  EXPECT_EQ(cut.copied_vertices, 1);
}

TEST(SurfaceFacts, FacesThatDisagree) {
  const Surface s = surface_of(4, {{0, 1, 2}, {0, 1, 3}});
  EXPECT_EQ(surface_facts(s).inconsistent_edges, 1);
  expect_sound(s, cut_into_manifold(s));
}

// The surface with the faces turned that are said to disagree.
Surface oriented(Surface s) {
  const std::vector<bool> turn = faces_to_turn(s);
  for (std::size_t f = 0; f < turn.size(); ++f)
    if (turn[f]) std::swap(s.triangles[f][1], s.triangles[f][2]);
  return s;
}

TEST(SurfaceFacts, TheFewerFacesAreTurned) {
  const auto sheet = testing::sheet(3, 4);
  Surface s;
  for (const auto& p : sheet.positions) s.vertices.push_back({p.i, p.j, p.k});
  s.triangles = sheet.faces;
  for (const std::size_t f : {0, 3, 4, 11, 20}) std::swap(s.triangles[f][0], s.triangles[f][2]);
  EXPECT_GT(cut_into_manifold(s).cut_edges, 0);
  const std::vector<bool> turn = faces_to_turn(s);
  EXPECT_EQ(std::count(turn.begin(), turn.end(), true), 5);
  EXPECT_TRUE(turn[0] && turn[3] && turn[4] && turn[11] && turn[20]);
  EXPECT_EQ(cut_into_manifold(oriented(s)).cut_edges, 0);
  // As many of both: the first face stays.
  EXPECT_EQ(faces_to_turn(surface_of(4, {{0, 1, 2}, {0, 1, 3}})), (std::vector<bool>{false, true}));
}

TEST(SurfaceFacts, OnlyPiecesThatCanBeOrientedAreTurned) {
  // A sound pair beside a Moebius strip; three faces at an edge say nothing about each other.
  std::vector<std::array<std::int32_t, 3>> t{{5, 6, 7}, {5, 6, 8}, {9, 10, 11}, {9, 10, 12}, {9, 10, 13}};
  for (std::int32_t n = 0; n < 5; ++n) t.push_back({n, (n + 1) % 5, (n + 2) % 5});
  const std::vector<bool> turn = faces_to_turn(surface_of(14, t));
  EXPECT_EQ(std::count(turn.begin(), turn.end(), true), 1);
  EXPECT_TRUE(turn[1]);
  EXPECT_TRUE(faces_to_turn(surface_of(3, {})).empty());
}

TEST(SurfaceFacts, MoebiusStripIsCutOpen) {
  std::vector<std::array<std::int32_t, 3>> t;
  for (std::int32_t n = 0; n < 5; ++n) t.push_back({n, (n + 1) % 5, (n + 2) % 5});
  for (std::size_t n = 0; n < 5; n += 2) std::swap(t[n][0], t[n][1]);
  const Surface s = surface_of(5, t);
  EXPECT_EQ(surface_facts(s).euler, 0);
  EXPECT_EQ(surface_facts(s).boundary_loops, 1);
  const CutSurface cut = cut_into_manifold(s);
  expect_sound(s, cut);
  EXPECT_GT(cut.cut_edges, 0);
}

TEST(SurfaceFacts, DegenerateFaceIsKeptApart) {
  const Surface s = surface_of(4, {{0, 1, 2}, {1, 1, 2}, {2, 1, 3}});
  const SurfaceFacts f = surface_facts(s);
  EXPECT_EQ(f.degenerate_faces, 1);
  EXPECT_EQ(f.components, 2);
  EXPECT_EQ(f.euler, 1);
  const CutSurface cut = cut_into_manifold(s);
  expect_sound(s, cut);
  EXPECT_EQ(cut.pieces, 2);
}

TEST(SurfaceFacts, SameFaceTwiceAndInsideOut) {
  for (const auto& twin : {std::array<std::int32_t, 3>{0, 1, 2}, {1, 0, 2}}) {
    const Surface s = surface_of(3, {{0, 1, 2}, twin, {0, 1, 2}});
    EXPECT_EQ(surface_facts(s).nonmanifold_edges, 3);
    expect_sound(s, cut_into_manifold(s));
  }
}

TEST(SurfaceFacts, RandomSoupIsAlwaysCutIntoAMesh) {
  std::mt19937 random(3);
  for (int round = 0; round < 300; ++round) {
    std::vector<std::array<std::int32_t, 3>> t;
    const int vertices = 3 + static_cast<int>(random() % 12), faces = static_cast<int>(random() % 40);
    for (int f = 0; f < faces; ++f) {
      std::array<std::int32_t, 3> face;
      for (auto& v : face) v = static_cast<std::int32_t>(random() % vertices);
      t.push_back(face);
    }
    const Surface s = surface_of(vertices, t);
    expect_sound(s, cut_into_manifold(s));
    expect_sound(oriented(s), cut_into_manifold(oriented(s)));
    if (HasFailure()) FAIL() << "round " << round;
  }
}

TEST(SurfaceFacts, RefusesBrokenFiles) {
  EXPECT_THROW(surface_facts(surface_of(3, {{0, 1, 3}})), Error);
  EXPECT_THROW(cut_into_manifold(surface_of(3, {{0, 1, -1}})), Error);
  Surface nan = surface_of(3, {{0, 1, 2}});
  nan.vertices[2].z = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(surface_facts(nan), Error);
  EXPECT_EQ(surface_facts(surface_of(0, {})), SurfaceFacts{});
}

}  // namespace
}  // namespace footwall::mesh
