#include "engine/service/resident/face_model.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/service/engine.pb.h"
#include "engine/service/wire.h"
#include "rounds.h"
#include "storage/base/error.h"

namespace footwall::service {
namespace {

using extract::Face;

Face face(std::int64_t fault, std::int32_t n, std::int32_t place = 0) {
  return {fault, 3, n, {{{place, 0, 0}, {place + 256, 0, 0}, {place, 512, 256}}}};
}

v1::EditBatch put(std::uint64_t edit, const std::vector<Face>& faces) {
  v1::EditBatch batch;
  batch.set_edit(edit);
  *batch.add_edits()->mutable_put() = message_of(std::span(faces));
  return batch;
}

void add(const mesh::Operation& operation, v1::EditBatch& batch) {
  const auto bytes = mesh::encode(std::span(&operation, 1));
  batch.add_edits()->set_mesh(bytes.data(), bytes.size());
}

// A square of two triangles.
mesh::CreateMesh square() {
  return {{{0, 0, 0}, {256, 0, 0}, {256, 256, 0}, {0, 256, 0}}, {{0, 1, 2}, {0, 2, 3}}};
}

std::string why_not(FaceModel& model, const v1::EditBatch& batch) {
  const std::uint64_t hash = model.hash();
  const FaceModel::Faces faces = model.faces();
  std::string why;
  try {
    model.apply(batch);
  } catch (const Error& error) {
    why = error.message();
  }
  EXPECT_EQ(model.hash(), hash);
  EXPECT_EQ(model.faces(), faces);
  return why;
}

TEST(FaceModel, PutsRemovesAndReplaces) {
  FaceModel model;
  model.apply(put(1, {face(1, 0), face(1, 1), face(2, 0)}));
  EXPECT_EQ(model.faces().size(), 3U);
  v1::EditBatch batch;
  batch.set_edit(5);
  const std::vector<Face> gone{face(2, 0)};
  *batch.add_edits()->mutable_remove() = names_of(std::span(gone));
  v1::ReplaceFault& replace = *batch.add_edits()->mutable_replace();
  replace.set_fault(1);
  const std::vector<Face> now{face(1, 1), face(1, 2)};
  *replace.mutable_faces() = message_of(std::span(now));
  const FaceModel::Change change = model.apply(batch);
  EXPECT_EQ(model.edit(), 5U);
  ASSERT_EQ(model.faces().size(), 2U);
  EXPECT_TRUE(model.faces().contains({1, 3, 2}));
  // (1, 1) stayed as it was, and does not count as changed.
  EXPECT_EQ(change.names().size(), 3U);
}

TEST(FaceModel, TheHashIsThatOfWhatIsThereWhateverTheOrder) {
  FaceModel one;
  one.apply(put(1, {face(1, 0), face(1, 1)}));
  one.apply(put(2, {face(1, 0, 77)}));
  FaceModel other;
  other.apply(put(1, {face(1, 1)}));
  EXPECT_NE(one.hash(), other.hash());
  other.apply(put(2, {face(1, 0, 77)}));
  EXPECT_EQ(one.hash(), other.hash());
}

TEST(FaceModel, RefusesABatchAsAWhole) {
  FaceModel model;
  v1::EditBatch start = put(4, {face(1, 0)});
  add(square(), start);
  model.apply(start);

  EXPECT_NE(why_not(model, put(4, {face(1, 1)})).find("edit 4 is not newer than edit 4"), std::string::npos);
  EXPECT_NE(why_not(model, put(5, {face(1, 1), face(-1, 0)})).find("face 0 of fault -1"), std::string::npos);
  Face beyond = face(1, 9);
  beyond.triangle[1].k = std::numeric_limits<std::int32_t>::min();
  EXPECT_NE(why_not(model, put(5, {face(1, 1), beyond})).find("face 9 of fault 1"), std::string::npos);

  v1::EditBatch batch = put(5, {face(7, 7)});
  const std::vector<Face> absent{face(9, 9)};
  *batch.add_edits()->mutable_remove() = names_of(std::span(absent));
  EXPECT_NE(why_not(model, batch).find("no such face"), std::string::npos);

  // Mesh operations, too, that were done before the refusal: ids are free again.
  batch = {};
  batch.set_edit(5);
  add(mesh::MoveVertex{0, 1, {300, 7, 5}}, batch);
  add(square(), batch);
  add(mesh::AddFace{1, 0, survey::LatticePoint{0, 0, 999}}, batch);
  add(mesh::RemoveFace{0, 0}, batch);
  add(mesh::DestroyMesh{0}, batch);
  add(mesh::MoveVertex{0, 1, {0, 0, 0}}, batch);
  EXPECT_NE(why_not(model, batch).find("mesh 0"), std::string::npos);
  batch.mutable_edits()->RemoveLast();
  batch.add_edits();
  EXPECT_FALSE(why_not(model, batch).empty());
  batch.mutable_edits()->RemoveLast();
  batch.add_edits()->set_clear(true);
  batch.add_edits()->set_mesh("not an operation");
  EXPECT_FALSE(why_not(model, batch).empty());

  batch = {};
  add(square(), batch);
  EXPECT_EQ(model.apply(batch).made().at(0).mesh, 1);
  EXPECT_EQ(model.edit(), 5U);
}

TEST(FaceModel, MeshFacesHaveNamesOfTheirOwn) {
  FaceModel model;
  v1::EditBatch batch;
  add(square(), batch);
  model.apply(batch);
  EXPECT_EQ(model.edit(), 1U);
  EXPECT_TRUE(model.faces().contains({-1, 0, 0}));
  EXPECT_TRUE(model.faces().contains({-1, 0, 1}));
  batch = {};
  add(mesh::DestroyMesh{0}, batch);
  model.apply(batch);
  EXPECT_TRUE(model.faces().empty());
}

// Random batches, some refused, some taken back: the model is always that of the batches that stayed.
TEST(FaceModel, TakingBackLeavesNoTrace) {
  std::mt19937 random(5);
  const auto place = [&] { return static_cast<std::int32_t>(random() % 4000); };
  for (int round = 0; round < rounds(30); ++round) {
    FaceModel model;
    FaceModel straight;
    for (int n = 0; n < 40; ++n) {
      v1::EditBatch batch;
      for (std::uint64_t edits = 1 + random() % 4; edits > 0; --edits) {
        const auto mesh = static_cast<mesh::MeshId>(random() % 4);
        const auto id = static_cast<std::int32_t>(random() % 6);
        switch (random() % 9) {
          case 0:
            add(square(), batch);
            break;
          case 1:
            add(mesh::MoveVertex{mesh, id, {place(), place(), place()}}, batch);
            break;
          case 2:
            add(mesh::AddFace{mesh, id, survey::LatticePoint{place(), place(), place()}}, batch);
            break;
          case 3:
            add(mesh::RemoveFaces{mesh, id}, batch);
            break;
          case 4:
            add(mesh::SplitEdge{mesh, id, {place(), place(), place()}}, batch);
            break;
          case 5:
            if (random() % 4 == 0) add(mesh::DestroyMesh{mesh}, batch);
            break;
          case 6:
            if (random() % 9 == 0) batch.add_edits()->set_clear(true);
            break;
          default: {
            const std::vector<Face> faces{face(1, id, place())};
            *batch.add_edits()->mutable_put() = message_of(std::span(faces));
          }
        }
      }
      std::optional<FaceModel::Change> change;
      try {
        change = model.apply(batch);
      } catch (const Error&) {
      }
      if (change && random() % 2 == 0) {
        model.undo(std::move(*change));
      } else if (change) {
        straight.apply(batch);
      }
      ASSERT_EQ(model.hash(), straight.hash()) << "round " << round << ", batch " << n;
      ASSERT_EQ(model.faces(), straight.faces());
    }
  }
}

}  // namespace
}  // namespace footwall::service
