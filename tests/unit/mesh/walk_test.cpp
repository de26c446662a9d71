#include "engine/mesh/walk.h"

#include <gtest/gtest.h>

#include <set>

#include "unit/mesh/grid.h"

namespace footwall::mesh {
namespace {

using testing::sheet_mesh;

TEST(Walk, InnerVertexHasSixFacesInTurn) {
  const Mesh m = sheet_mesh(2, 2);
  const auto fan = faces_of(m, 4);
  const auto edges = edges_of(m, 4);
  ASSERT_EQ(fan.size(), 6u);
  ASSERT_EQ(edges.size(), 6u);
  EXPECT_EQ(std::set<FaceId>(fan.begin(), fan.end()).size(), 6u);
  // edges[n] lies between fan[n - 1] and fan[n].
  for (std::size_t n = 0; n < 6; ++n) EXPECT_EQ(across(m, fan[(n + 5) % 6], edges[n]), fan[n]);
}

TEST(Walk, BorderVertexHasOneMoreEdgeThanFaces) {
  const Mesh m = sheet_mesh(2, 2);
  EXPECT_EQ(faces_of(m, 1).size() + 1, edges_of(m, 1).size());
  EXPECT_TRUE(m.is_border_edge(edges_of(m, 1).front()));
  EXPECT_TRUE(m.is_border_edge(edges_of(m, 1).back()));
}

TEST(Walk, WingsAreTheNeighboursInBothFaces) {
  const Mesh m = sheet_mesh(1, 1);  // faces (0,2,3) and (0,3,1)
  const EdgeId diagonal = edge_between(m, 0, 3);
  const Edge e = m.edge(diagonal);
  const Wings w = m.wings(diagonal);
  for (int side = 0; side < 2; ++side) {
    const EdgeId before = side == 0 ? w.left_before : w.right_before;
    const EdgeId after = side == 0 ? w.left_after : w.right_after;
    const Edge b = m.edge(before), a = m.edge(after);
    EXPECT_TRUE(b.vertices[0] == e.vertices[side] || b.vertices[1] == e.vertices[side]);
    EXPECT_TRUE(a.vertices[0] == e.vertices[1 - side] || a.vertices[1] == e.vertices[1 - side]);
    EXPECT_NE(before, after);
  }
  const Wings border = m.wings(edge_between(m, 0, 2));
  EXPECT_TRUE((border.left_before == kNone) != (border.right_before == kNone));
}

TEST(Walk, LoopsRunWithTheFacesToTheLeft) {
  Mesh m = sheet_mesh(3, 3);
  m.remove_faces(std::vector<FaceId>{8, 9});  // the middle square
  const auto loops = boundary_loops(m);
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_EQ(loops[0].size(), 12u);
  EXPECT_EQ(loops[1].size(), 4u);
  for (const auto& loop : loops) {
    for (std::size_t n = 0; n < loop.size(); ++n) {
      const VertexId from = loop[n], to = loop[(n + 1) % loop.size()];
      const Edge e = m.edge(edge_between(m, from, to));
      EXPECT_NE(e.faces[e.vertices[0] == from ? 0 : 1], kNone);
    }
  }
}

TEST(Walk, ComponentsAreThePieces) {
  Mesh m = sheet_mesh(1, 2);
  m.add_triangle({{{9, 0, 0}, {9, 1, 0}, {9, 0, 1}}});
  const auto pieces = components(m);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(pieces[0], (std::vector<FaceId>{0, 1, 2, 3}));
  EXPECT_EQ(pieces[1], (std::vector<FaceId>{4}));
}

TEST(Walk, EdgeBetweenStrangersIsNone) {
  EXPECT_EQ(edge_between(sheet_mesh(2, 2), 0, 8), kNone);
}

}  // namespace
}  // namespace footwall::mesh
