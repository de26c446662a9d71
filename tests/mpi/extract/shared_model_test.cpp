#include "engine/extract/model/shared_model.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/mesh/check.h"

namespace footwall::extract {
namespace {

using mesh::LatticePoint;
using mesh::Operation;

// Operations that fit a growing set of meshes, many of them to be refused.
std::vector<Operation> random_batch(const mesh::MeshSet& meshes, std::mt19937& random) {
  const auto below = [&](std::int32_t limit) {
    return static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(limit + 1));
  };
  const auto place = [&] { return LatticePoint{below(9000), below(9000), below(9000)}; };
  std::vector<Operation> batch;
  for (int n = 0; n < 40; ++n) {
    const mesh::MeshId id = below(meshes.mesh_limit());
    const bool there = meshes.has_mesh(id);
    const std::int32_t edges = there ? meshes.mesh(id).edge_limit() : 3;
    const std::int32_t vertices = there ? meshes.mesh(id).vertex_limit() : 3;
    switch (below(9)) {
      case 0:
        batch.emplace_back(mesh::CreateMesh{{place(), place(), place()}, {{0, 1, 2}}});
        break;
      case 1:
        if (below(5) == 0) batch.emplace_back(mesh::DestroyMesh{id});
        break;
      case 2:
        batch.emplace_back(mesh::RemoveFaces{id, below(vertices)});
        break;
      case 3:
        batch.emplace_back(mesh::SplitEdge{id, below(edges), place()});
        break;
      case 4:
        batch.emplace_back(mesh::AddFace{id, below(edges), below(vertices)});
        break;
      case 5:
        batch.emplace_back(mesh::MoveVertex{id, below(vertices), place()});
        break;
      default:
        batch.emplace_back(mesh::AddFace{id, below(edges), place()});
    }
  }
  return batch;
}

bool alike(const comm::Communicator& world, std::uint64_t value) {
  const auto half = static_cast<std::int64_t>(value >> 1);
  return world.maximum(half) == -world.maximum(-half);
}

std::uint64_t hash_of(const mesh::MeshSet& meshes) {
  std::uint64_t hash = 0;
  for (mesh::MeshId m = 0; m < meshes.mesh_limit(); ++m) {
    hash = hash * 31 + (meshes.has_mesh(m) ? mesh::state_hash(meshes.mesh(m)) : 7);
  }
  return hash;
}

TEST(SharedModel, IsTheSameOnEveryRankWithoutATalk) {
  const comm::Communicator world(MPI_COMM_WORLD);
  SharedModel model(world);
  std::mt19937 random(5);  // of rank 0's choices; the others' batches are not looked at
  std::size_t refused = 0, done = 0;
  for (int round = 0; round < 60; ++round) {
    const auto batch = world.rank() == 0 ? random_batch(model.meshes(), random) : std::vector<Operation>{};
    const SharedModel::Outcome outcome = model.apply(batch);
    std::uint64_t hash = outcome.applied.size();
    for (const mesh::Applied& each : outcome.applied)
      hash =
          hash * 31 + static_cast<std::uint64_t>(each.mesh * 7 + each.vertex * 5 + each.edge * 3 + each.face);
    for (const SharedModel::Refusal& each : outcome.refusals) {
      EXPECT_EQ(outcome.applied[each.operation], mesh::Applied{});
      hash = hash * 31 + std::hash<std::string>()(each.reason.message()) + each.operation;
    }
    EXPECT_TRUE(alike(world, hash)) << "round " << round;
    EXPECT_TRUE(alike(world, hash_of(model.meshes()))) << "round " << round;
    refused += outcome.refusals.size();
    done += outcome.applied.size() - outcome.refusals.size();
  }
  EXPECT_GT(refused, 100U);
  EXPECT_GT(done, 300U);
}

TEST(SharedModel, ChangesTurnTheOldFacesIntoTheNewOnes) {
  const comm::Communicator world(MPI_COMM_WORLD);
  SharedModel model(world);
  std::mt19937 random(6);
  std::map<FaceIdentity, Face> known;
  for (int round = 0; round < 60; ++round) {
    model.apply(world.rank() == 0 ? random_batch(model.meshes(), random) : std::vector<Operation>{});
    if (round % 2 == 1) continue;
    const FaceChanges changes = model.take_changes();
    for (const FaceIdentity& gone : changes.removed) EXPECT_EQ(known.erase(gone), 1U);
    for (const Face& face : changes.added) {
      EXPECT_TRUE(known.emplace(FaceIdentity{face.fault, face.owner, face.n}, face).second);
    }
    for (const Face& face : changes.changed) {
      const auto found = known.find({face.fault, face.owner, face.n});
      ASSERT_NE(found, known.end());
      found->second = face;
    }
    const std::vector<Face> faces = model.faces();
    ASSERT_EQ(faces.size(), known.size());
    auto expected = known.begin();
    for (const Face& face : faces) EXPECT_EQ(face, (expected++)->second);
  }
  EXPECT_GT(known.size(), 100U);
}

}  // namespace
}  // namespace footwall::extract
