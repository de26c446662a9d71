#include "engine/mesh/model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "engine/mesh/check.h"
#include "engine/mesh/walk.h"
#include "engine/verify/naive_mesh.h"
#include "rounds.h"

namespace footwall::mesh {
namespace {

using verify::NaiveMesh;
using Triangles = std::map<FaceKey, survey::LatticeTriangle>;

const CreateMesh kTriangle{{{0, 0, 0}, {256, 0, 0}, {0, 256, 0}}, {{0, 1, 2}}};

std::vector<FaceKey> keys(std::initializer_list<FaceKey> faces) {
  return faces;
}

Triangles triangles_of(const MeshSet& set) {
  Triangles triangles;
  for (const FaceKey& key : set.faces()) triangles[key] = set.triangle(key);
  return triangles;
}

TEST(Model, TellsTheFacesThatAnOperationTouched) {
  MeshSet set;
  EXPECT_EQ(set.apply(kTriangle), (Applied{0, kNone, kNone, 0}));
  EXPECT_EQ(set.apply(kTriangle).mesh, 1);
  const Applied made = set.apply(AddFace{1, 0, LatticePoint{0, -256, 0}});
  EXPECT_EQ(made, (Applied{1, 3, kNone, 1}));
  Changes changes = set.take_changes();
  EXPECT_EQ(changes.added, keys({{0, 0}, {1, 0}, {1, 1}}));
  EXPECT_TRUE(changes.changed.empty() && changes.removed.empty());
  EXPECT_TRUE(set.take_changes().empty());

  set.apply(MoveVertex{1, 3, {0, -512, 0}});
  set.apply(MoveVertex{1, 3, {0, -700, 0}});
  EXPECT_EQ(set.take_changes().changed, keys({{1, 1}}));
  set.apply(MoveVertex{1, 0, {1, 1, 1}});
  set.apply(SplitEdge{1, 0, {9, 9, 9}});
  changes = set.take_changes();
  EXPECT_EQ(changes.changed, keys({{1, 0}, {1, 1}}));
  EXPECT_EQ(changes.added, keys({{1, 2}, {1, 3}}));

  set.apply(AddFace{0, 0, LatticePoint{0, -256, 0}});
  set.apply(DestroyMesh{0});
  EXPECT_EQ(set.take_changes(), (Changes{{}, {}, keys({{0, 0}})})) << "face 1 came and went";
  EXPECT_FALSE(set.has_mesh(0));
  EXPECT_EQ(set.mesh_count(), 1);
  EXPECT_EQ(set.face_count(), 4);
  EXPECT_EQ(set.apply(kTriangle).mesh, 2) << "ids are not used again";
}

TEST(Model, RemovesEveryVertexOfAMesh) {
  MeshSet set;
  set.apply(kTriangle);
  set.apply(AddFace{0, 0, LatticePoint{0, -256, 0}});
  set.take_changes();
  for (const VertexId v : {3, 2}) set.apply(RemoveFaces{0, v});
  EXPECT_EQ(set.face_count(), 0);
  EXPECT_EQ(set.mesh(0).vertex_count(), 2) << "they stay without a face";
  EXPECT_TRUE(problems_of(set.mesh(0)).empty());
  set.apply(MoveVertex{0, 1, {3, 3, 3}});
  for (const VertexId v : {1, 0}) set.apply(RemoveFaces{0, v});
  EXPECT_EQ(set.mesh(0).vertex_count(), 0);
  EXPECT_EQ(set.take_changes().removed, keys({{0, 0}, {0, 1}}));
  EXPECT_THROW(set.apply(RemoveFaces{0, 0}), Error);
  set.apply(DestroyMesh{0});
  EXPECT_TRUE(set.take_changes().empty());
}

TEST(Model, RefusesByNameAndTakesNoId) {
  MeshSet set;
  set.apply(kTriangle);
  const std::uint64_t before = state_hash(set.mesh(0));
  const auto refusal = [&](const Operation& operation) -> std::string {
    try {
      set.apply(operation);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kInvalid);
      return error.message();
    }
    return "";
  };
  EXPECT_EQ(refusal(DestroyMesh{5}), "DESTROY-MESH on mesh 5 is refused: there is no mesh 5");
  EXPECT_EQ(refusal(AddFace{0, 9, LatticePoint{}}), "ADD-FACE on mesh 0 is refused: there is no mesh edge 9");
  EXPECT_FALSE(refusal(MoveVertex{0, 1, {2147483647, 0, 0}}).empty()) << "2^23 voxels away";
  EXPECT_FALSE(refusal(CreateMesh{{{0, 0, 0}}, {}}).empty());
  EXPECT_FALSE(refusal(CreateMesh{kTriangle.positions, {{0, 1, 3}}}).empty());
  EXPECT_FALSE(refusal(AddFace{0, 0, VertexId{2}}).empty()) << "the same face";
  EXPECT_EQ(state_hash(set.mesh(0)), before);
  EXPECT_EQ(set.mesh_limit(), 1);
  EXPECT_EQ(set.take_changes().added, keys({{0, 0}}));
}

TEST(Model, DestroyedMeshIsGoneAtOnce) {
  MeshSet set;
  set.apply(kTriangle);
  set.apply(DestroyMesh{0});
  EXPECT_TRUE(set.faces().empty());
  EXPECT_THROW(set.mesh(0), Error);
  EXPECT_THROW(set.apply(DestroyMesh{0}), Error);
  EXPECT_TRUE(set.take_changes().empty()) << "it came and went";
}

// The smallest vertex first: where a face's cycle starts does not matter.
NaiveMesh::Corners turned(NaiveMesh::Corners corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

// Random operations on one mesh and on the naive one.
class Pair {
 public:
  explicit Pair(MeshSet& set)
      : set_(set),
        id_(set.apply(kTriangle).mesh),
        naive_({kTriangle.positions[0], kTriangle.positions[1], kTriangle.positions[2]}) {}
  // Whether it was done; tells gtest where the two differ.
  bool step(std::mt19937& random) {
    const Operation operation = pick(random);
    const std::uint64_t before = state_hash(mesh());
    const bool expected = naive(operation);
    bool done = true;
    try {
      set_.apply(decode(encode(std::span(&operation, 1))).at(0));
    } catch (const Error&) {
      done = false;
    }
    EXPECT_EQ(done, expected) << name_of(operation);
    if (!done) {
      EXPECT_EQ(state_hash(mesh()), before) << name_of(operation);
    }
    compare();
    return done;
  }
  MeshId id() const { return id_; }
  const Mesh& mesh() const { return set_.mesh(id_); }

 private:
  Operation pick(std::mt19937& random) {
    const auto below = [&](std::int32_t limit) {  // often an id that is not there
      return static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(limit + 1));
    };
    const auto recent = [&](std::int32_t limit) { return std::max(0, limit - below(40)); };
    const auto place = [&] { return LatticePoint{below(5000) - 900, below(5000) - 900, below(5000) - 900}; };
    // A removed mesh cannot grow again; a large one makes the naive one slow.
    const bool small = mesh().face_count()<12, large = mesh().face_count()> 60;
    switch (random() % 12) {
      case 0:
        return small ? Operation(AddFace{id_, recent(mesh().edge_limit()), place()})
                     : Operation(RemoveFaces{id_, recent(mesh().vertex_limit())});
      case 1:
      case 2:
        return small ? Operation(MoveVertex{id_, recent(mesh().vertex_limit()), place()})
                     : Operation(RemoveFace{id_, recent(mesh().face_limit())});
      case 3:
        return MoveVertex{id_, recent(mesh().vertex_limit()), place()};
      case 4:
        return large ? Operation(RemoveFace{id_, recent(mesh().face_limit())})
                     : Operation(SplitEdge{id_, recent(mesh().edge_limit()), place()});
      case 5:
      case 6:
      case 7:
      case 8:
        return AddFace{id_, recent(mesh().edge_limit()), recent(mesh().vertex_limit())};
      default:
        return large ? Operation(RemoveFaces{id_, recent(mesh().vertex_limit())})
                     : Operation(AddFace{id_, recent(mesh().edge_limit()), place()});
    }
  }

  bool naive(const Operation& operation) {
    if (const auto* o = std::get_if<RemoveFaces>(&operation)) return naive_.remove_faces(o->vertex);
    if (const auto* o = std::get_if<RemoveFace>(&operation)) return naive_.remove_face(o->face);
    if (const auto* o = std::get_if<MoveVertex>(&operation)) return naive_.move_vertex(o->vertex, o->to);
    if (const auto* o = std::get_if<SplitEdge>(&operation)) {
      if (!mesh().has_edge(o->edge)) return false;
      const Edge& e = mesh().edge(o->edge);
      return naive_.split_edge(e.vertices[0], e.vertices[1], o->at);
    }
    const AddFace& o = std::get<AddFace>(operation);
    if (!mesh().has_edge(o.border_edge)) return false;
    const Edge& e = mesh().edge(o.border_edge);
    return std::visit([&](const auto& apex) { return naive_.add_face(e.vertices[0], e.vertices[1], apex); },
                      o.apex);
  }

  void compare() {
    std::map<std::int32_t, NaiveMesh::Corners> faces;
    for (FaceId f = 0; f < mesh().face_limit(); ++f) {
      if (mesh().has_face(f)) faces[f] = turned(mesh().face(f).vertices);
    }
    std::map<std::int32_t, NaiveMesh::Corners> expected;
    for (const auto& [id, corners] : naive_.faces()) expected[id] = turned(corners);
    EXPECT_EQ(faces, expected);
    std::map<std::int32_t, LatticePoint> vertices;
    for (VertexId v = 0; v < mesh().vertex_limit(); ++v) {
      const survey::IndexPoint none;
      const auto& p = mesh().has_vertex(v) ? mesh().position(v) : none;
      if (mesh().has_vertex(v))
        vertices[v] = {static_cast<std::int32_t>(p.i * 256), static_cast<std::int32_t>(p.j * 256),
                       static_cast<std::int32_t>(p.k * 256)};
    }
    EXPECT_EQ(vertices, naive_.vertices());
    EXPECT_EQ(mesh().face_limit(), naive_.next_face());
    EXPECT_EQ(mesh().vertex_limit(), naive_.next_vertex());
    EXPECT_EQ(static_cast<std::size_t>(mesh().edge_count()), naive_.edge_count());
  }

  MeshSet& set_;
  MeshId id_;
  NaiveMesh naive_;
};

void compare_changes(const Changes& told, const Triangles& before, const Triangles& after) {
  std::vector<FaceKey> added, removed, differ;
  for (const auto& [key, triangle] : after) {
    const auto was = before.find(key);
    if (was == before.end()) {
      added.push_back(key);
    } else if (was->second != triangle) {
      differ.push_back(key);
    }
  }
  for (const auto& [key, triangle] : before) {
    if (!after.contains(key)) removed.push_back(key);
  }
  EXPECT_EQ(told.added, added);
  EXPECT_EQ(told.removed, removed);
  EXPECT_TRUE(std::includes(told.changed.begin(), told.changed.end(), differ.begin(), differ.end()));
  for (const FaceKey& key : told.changed) EXPECT_TRUE(before.contains(key) && after.contains(key));
}

TEST(Model, AgreesWithTheNaiveOneUnderRandomOperations) {
  std::mt19937 random(11);
  MeshSet set;
  std::vector<Pair> pairs;
  int done = 0, refused = 0;
  Triangles before;
  for (int n = 0; n < rounds(2500); ++n) {
    if (n % 2000 == 0) {
      for (const Pair& old : pairs) set.apply(DestroyMesh{old.id()});
      pairs.clear();
      for (int mesh = 0; mesh < 3; ++mesh) pairs.emplace_back(set);
    }
    Pair& pair = pairs[random() % pairs.size()];
    ++(pair.step(random) ? done : refused);
    if (n % 7 == 0) {
      Triangles after = triangles_of(set);
      compare_changes(set.take_changes(), before, after);
      before = std::move(after);
      const auto problems = problems_of(pair.mesh());
      ASSERT_TRUE(problems.empty()) << problems.front() << " after " << n;
    }
    ASSERT_FALSE(::testing::Test::HasFailure()) << "after " << n;
  }
  EXPECT_GT(done, 500);
  EXPECT_GT(refused, 500);
}

}  // namespace
}  // namespace footwall::mesh
