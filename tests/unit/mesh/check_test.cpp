#include "engine/mesh/check.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "unit/mesh/grid.h"

namespace footwall::mesh {

struct MeshTestAccess {
  static std::vector<Edge>& edges(Mesh& m) { return m.edges_; }
  static std::vector<Face>& faces(Mesh& m) { return m.faces_; }
  static std::int32_t& face_count(Mesh& m) { return m.face_count_; }
  static void start(Mesh& m, VertexId v, EdgeId e) { m.vertices_[v].edge = e; }
};

namespace {

TEST(Check, FindsEveryKindOfDamage) {
  const Mesh sound = testing::sheet_mesh(2, 2);
  EXPECT_TRUE(problems_of(sound).empty());
  Mesh turned = sound;
  std::swap(MeshTestAccess::faces(turned)[0].vertices[0], MeshTestAccess::faces(turned)[0].vertices[1]);
  EXPECT_FALSE(problems_of(turned).empty());
  Mesh unlinked = sound;
  MeshTestAccess::edges(unlinked)[3].faces[0] = kNone;
  EXPECT_FALSE(problems_of(unlinked).empty());
  Mesh miscounted = sound;
  ++MeshTestAccess::face_count(miscounted);
  EXPECT_EQ(problems_of(miscounted).size(), 1u);
  Mesh misplaced = sound;
  MeshTestAccess::start(misplaced, 0, sound.fan_start(8));
  EXPECT_FALSE(problems_of(misplaced).empty());
  Mesh pinched = sound;  // taking both faces between two others at the middle vertex behind the mesh's back
  for (FaceId f : {0, 1, 6, 7}) {
    for (EdgeId e : pinched.face(f).edges) {
      auto& sides = MeshTestAccess::edges(pinched)[e].faces;
      sides[sides[0] == f ? 0 : 1] = kNone;
    }
    MeshTestAccess::faces(pinched)[f] = Face{};
    --MeshTestAccess::face_count(pinched);
  }
  const auto problems = problems_of(pinched);
  EXPECT_TRUE(std::any_of(problems.begin(), problems.end(), [](const std::string& p) {
    return p.find("vertex 4 form more than one fan") != p.npos;
  }));
}

TEST(Check, StopsAtTheLimit) {
  Mesh broken = testing::sheet_mesh(6, 6);
  for (Edge& e : MeshTestAccess::edges(broken)) e.faces = {kNone, kNone};
  EXPECT_EQ(problems_of(broken, 5).size(), 5u);
}

}  // namespace
}  // namespace footwall::mesh
