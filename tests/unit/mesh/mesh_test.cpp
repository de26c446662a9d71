#include "engine/mesh/mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "engine/mesh/check.h"
#include "engine/mesh/walk.h"
#include "rounds.h"
#include "storage/base/error.h"
#include "unit/mesh/grid.h"

namespace footwall::mesh {
namespace {

using survey::IndexPoint;
using testing::sheet_mesh;

const std::array<IndexPoint, 3> kTriangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};

// All records, to see that a refused operation changed nothing.
struct Snapshot {
  std::vector<Face> faces;
  std::vector<Edge> edges;
  std::vector<EdgeId> starts;
  explicit Snapshot(const Mesh& m) {
    for (FaceId f = 0; f < m.face_limit(); ++f) faces.push_back(m.has_face(f) ? m.face(f) : Face{});
    for (EdgeId e = 0; e < m.edge_limit(); ++e) edges.push_back(m.has_edge(e) ? m.edge(e) : Edge{});
    for (VertexId v = 0; v < m.vertex_limit(); ++v)
      starts.push_back(m.has_vertex(v) ? m.fan_start(v) : kNone);
  }
  bool operator==(const Snapshot&) const = default;
};

TEST(Mesh, SheetHasTheCountsOfEuler) {
  const Mesh m = sheet_mesh(5, 7);
  EXPECT_EQ(m.vertex_count(), 48);
  EXPECT_EQ(m.face_count(), 70);
  EXPECT_EQ(m.vertex_count() - m.edge_count() + m.face_count(), 1);
  EXPECT_TRUE(problems_of(m).empty());
}

TEST(Mesh, VertexWithoutFaceIsNotThere) {
  const std::vector<IndexPoint> p{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}};
  const std::vector<std::array<VertexId, 3>> f{{0, 1, 2}};
  const Mesh m(p, f);
  EXPECT_EQ(m.vertex_count(), 3);
  EXPECT_FALSE(m.has_vertex(3));
  EXPECT_THROW(m.position(3), Error);
}

TEST(Mesh, RefusesWhatIsNotManifold) {
  const std::vector<IndexPoint> p{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  using Faces = std::vector<std::array<VertexId, 3>>;
  EXPECT_THROW(Mesh(p, Faces({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}})), Error) << "three faces at an edge";
  EXPECT_THROW(Mesh(p, Faces({{0, 1, 2}, {0, 1, 3}})), Error) << "two faces that disagree";
  EXPECT_THROW(Mesh(p, Faces({{0, 1, 2}, {0, 3, 4}})), Error) << "bow-tie";
  EXPECT_THROW(Mesh(p, Faces({{0, 1, 1}})), Error);
  EXPECT_THROW(Mesh(p, Faces({{0, 1, 5}})), Error);
  EXPECT_THROW(Mesh(p, Faces({{0, -1, 2}})), Error);
  std::vector<IndexPoint> nan = p;
  nan[1].j = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Mesh(nan, Faces({{0, 1, 2}})), Error);
}

TEST(Mesh, GrowsAFanUntilItCloses) {
  Mesh m;
  m.add_triangle(kTriangle);
  // Turn around vertex 0: each face hangs on the last edge at it.
  VertexId last = 2;
  for (int n = 0; n < 3; ++n) last = m.add_face(edge_between(m, 0, last), {-1.0, -double(n), 0}).vertex;
  EXPECT_TRUE(m.is_border_vertex(0));
  const AddedFace closing = m.add_face(edge_between(m, 0, last), VertexId{1});
  EXPECT_EQ(closing.vertex, 1);
  EXPECT_FALSE(m.is_border_vertex(0));
  EXPECT_EQ(faces_of(m, 0).size(), 5u);
  EXPECT_TRUE(problems_of(m).empty());
}

TEST(Mesh, RefusesFacesThatWouldNotBeManifoldAndStaysAsItWas) {
  Mesh m = sheet_mesh(2, 2);
  const AddedFace other = m.add_triangle(kTriangle);
  const Snapshot before(m);
  EXPECT_THROW(m.add_face(edge_between(m, 0, 1), other.vertex), Error) << "another piece, in one point";
  EXPECT_THROW(m.add_face(edge_between(m, 0, 1), VertexId{8}), Error) << "the far corner, in one point";
  EXPECT_THROW(m.add_face(edge_between(m, 0, 1), VertexId{4}), Error) << "an inner vertex";
  EXPECT_THROW(m.add_face(edge_between(m, 0, 4), VertexId{8}), Error) << "an inner edge";
  EXPECT_THROW(m.add_face(edge_between(m, 0, 1), VertexId{0}), Error) << "an end of the edge";
  EXPECT_THROW(m.add_face(edge_between(m, 9, 10), VertexId{11}), Error) << "the same face";
  EXPECT_THROW(m.add_face(edge_between(m, 0, 1), IndexPoint{0, std::nan(""), 0}), Error);
  EXPECT_THROW(m.add_face(EdgeId{-3}, VertexId{0}), Error);
  EXPECT_EQ(Snapshot(m), before);
  EXPECT_TRUE(problems_of(m).empty());
}

TEST(Mesh, RemovesAllOrNone) {
  Mesh m = sheet_mesh(3, 3);
  const Snapshot before(m);
  // The two squares at opposite sides of inner vertex 5: what stays would meet there twice.
  EXPECT_THROW(m.remove_faces(std::vector<FaceId>{0, 1, 8, 9}), Error);
  EXPECT_THROW(m.remove_faces(std::vector<FaceId>{2, 2}), Error);
  EXPECT_THROW(m.remove_faces(std::vector<FaceId>{2, 99}), Error);
  EXPECT_EQ(Snapshot(m), before);
  m.remove_faces(std::vector<FaceId>{8, 9});
  EXPECT_TRUE(problems_of(m).empty());
  EXPECT_EQ(boundary_loops(m).size(), 2u);
}

TEST(Mesh, IdsAreNeverUsedAgain) {
  Mesh m;
  const FaceId first = m.add_triangle(kTriangle).face;
  m.remove_face(first);
  EXPECT_EQ(m.vertex_count() + m.edge_count() + m.face_count(), 0);
  const AddedFace second = m.add_triangle(kTriangle);
  EXPECT_GT(second.face, first);
  EXPECT_EQ(second.vertex, 5);
  EXPECT_FALSE(m.has_face(first));
}

TEST(Mesh, SplitsAnEdgeAndTheFacesBesideIt) {
  Mesh m = sheet_mesh(1, 1);  // faces (0, 2, 3) and (0, 3, 1)
  const EdgeId diagonal = edge_between(m, 0, 3);
  const EdgeSplit inner = m.split_edge(diagonal, {0.5, 0.5, 1});
  EXPECT_EQ(inner.vertex, 4);
  EXPECT_EQ(m.face_count(), 4);
  EXPECT_EQ(m.edge(diagonal).vertices, (std::array<VertexId, 2>{m.edge(diagonal).vertices[0], 4}));
  EXPECT_FALSE(m.is_border_vertex(4));
  EXPECT_EQ(faces_of(m, 4).size(), 4u);
  EXPECT_TRUE(problems_of(m).empty());
  const EdgeSplit border = m.split_edge(edge_between(m, 0, 1), {0, 0.5, 0});
  EXPECT_EQ(std::count(border.faces.begin(), border.faces.end(), kNone), 1);
  EXPECT_TRUE(m.is_border_vertex(border.vertex));
  EXPECT_EQ(m.face_count(), 5);
  EXPECT_TRUE(problems_of(m).empty());
  const Snapshot before(m);
  EXPECT_THROW(m.split_edge(99, {0, 0, 0}), Error);
  EXPECT_THROW(m.split_edge(diagonal, {0, std::nan(""), 0}), Error);
  EXPECT_EQ(Snapshot(m), before);
}

TEST(Mesh, RemovesTheFacesAroundAVertexAndNoOther) {
  Mesh m = sheet_mesh(2, 2);
  EXPECT_EQ(m.remove_faces_around(4).size(), 6u) << "the middle";
  EXPECT_FALSE(m.has_vertex(4));
  EXPECT_EQ(m.vertex_count(), 8);
  EXPECT_TRUE(m.is_lone_vertex(0));
  EXPECT_TRUE(m.is_lone_vertex(8));
  EXPECT_EQ(m.fan_start(0), kNone);
  EXPECT_TRUE(edges_of(m, 0).empty());
  EXPECT_FALSE(m.is_border_vertex(0));
  EXPECT_TRUE(problems_of(m).empty());
  // A lone vertex takes part again.
  m.add_face(edge_between(m, 1, 2), VertexId{0});
  EXPECT_FALSE(m.is_lone_vertex(0));
  EXPECT_TRUE(m.remove_faces_around(8).empty());
  EXPECT_THROW(m.remove_faces_around(8), Error);
  EXPECT_TRUE(problems_of(m).empty());
}

TEST(Mesh, EdgesOfAFaceFollowEachOther) {
  const Mesh m = sheet_mesh(1, 1);
  const Face& face = m.face(1);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(m.next_edge(1, face.edges[k]), face.edges[(k + 1) % 3]);
    EXPECT_EQ(m.previous_edge(1, m.next_edge(1, face.edges[k])), face.edges[k]);
  }
  EXPECT_THROW(m.next_edge(1, edge_between(m, 0, 2)), Error) << "an edge of the other face";
}

TEST(Mesh, MovesAVertex) {
  Mesh m = sheet_mesh(1, 1);
  m.move_vertex(2, {4, 5, 6});
  EXPECT_EQ(m.position(2), (IndexPoint{4, 5, 6}));
  EXPECT_THROW(m.move_vertex(2, {4, 5, std::numeric_limits<double>::infinity()}), Error);
  EXPECT_THROW(m.move_vertex(7, {4, 5, 6}), Error);
  EXPECT_EQ(m.position(2), (IndexPoint{4, 5, 6}));
}

TEST(Mesh, StaysSoundUnderRandomOperations) {
  std::mt19937 random(7);
  Mesh m = sheet_mesh(4, 4);
  int done = 0, refused = 0;
  for (int n = 0; n < rounds(3000); ++n) {
    const auto pick = [&](std::int32_t limit) { return static_cast<std::int32_t>(random() % limit); };
    try {
      switch (random() % 3) {
        case 0:
          m.add_face(pick(m.edge_limit()), IndexPoint{double(n), 0, 1});
          break;
        case 1:
          m.add_face(pick(m.edge_limit()), pick(m.vertex_limit()));
          break;
        default:
          m.remove_face(pick(m.face_limit()));
      }
      ++done;
    } catch (const Error&) {
      ++refused;
    }
    if (n % rounds(10) != 0) continue;  // a look at all takes longer, the more there was
    const auto problems = problems_of(m);
    ASSERT_TRUE(problems.empty()) << problems.front() << " after " << n;
  }
  EXPECT_GT(done, 300);
  EXPECT_GT(refused, 300);
}

}  // namespace
}  // namespace footwall::mesh
