#include "engine/service/client/edit_journal.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/service/resident/face_model.h"
#include "engine/service/wire.h"
#include "storage/base/error.h"

namespace footwall::service {
namespace {

extract::Face face(std::int64_t fault, std::int64_t owner, std::int32_t place) {
  extract::Face made;
  made.fault = fault;
  made.owner = owner;
  made.triangle = {{{place, 0, 0}, {0, place, 0}, {0, 0, place}}};
  return made;
}

v1::Faces message(const std::vector<extract::Face>& faces) {
  return message_of(std::span<const extract::Face>(faces));
}

// A model as an engine holds it, after the replay of a project with these faces.
FaceModel replayed(const std::vector<extract::Face>& project) {
  FaceModel model;
  v1::EditBatch batch;
  batch.add_edits()->set_clear(true);
  *batch.add_edits()->mutable_put() = message(project);
  model.apply(batch, {});
  return model;
}

void tell(FaceModel& model, const EditJournal& journal) {
  for (const v1::EditBatch& batch : journal.batches()) model.apply(batch, {});
}

// Whatever an engine has taken, a fresh one is brought to the same faces.
TEST(EditJournal, BringsAFreshEngineToTheSameFaces) {
  const std::vector<extract::Face> project{face(1, 0, 5), face(1, 1, 6), face(2, 0, 7)};
  std::mt19937 random(3);
  for (int round = 0; round < 200; ++round) {
    FaceModel model = replayed(project);
    EditJournal journal;
    for (int n = 0; n < 12; ++n) {
      v1::EditBatch batch;
      const auto fault = static_cast<std::int64_t>(random() % 3);
      const auto owner = static_cast<std::int64_t>(random() % 3);
      const auto place = static_cast<std::int32_t>(random() % 100);
      switch (random() % 8) {
        case 0:
          *batch.add_edits()->mutable_remove() = names_of(std::vector{face(fault, owner, 0)});
          break;
        case 1:
          batch.add_edits()->mutable_replace()->set_fault(fault);
          *batch.mutable_edits(0)->mutable_replace()->mutable_faces() = message({face(fault, owner, place)});
          break;
        case 2:
          batch.add_edits()->set_clear(true);
          break;
        default:
          *batch.add_edits()->mutable_put() = message({face(fault, owner, place)});
      }
      try {
        model.apply(batch, {});
      } catch (const Error&) {
        continue;  // refused: a face that is not there
      }
      journal.add(batch);
    }
    FaceModel fresh = replayed(project);
    tell(fresh, journal);
    ASSERT_EQ(fresh.faces(), model.faces()) << round;
    // Also where the project has them by now, or lost some.
    FaceModel later = replayed({project.back()});
    ASSERT_NO_THROW(tell(later, journal)) << round;
    tell(fresh, journal);
    ASSERT_EQ(fresh.faces(), model.faces()) << round;
  }
}

TEST(EditJournal, GrowsWithFacesNotWithMoves) {
  EditJournal journal;
  v1::EditBatch batch;
  for (std::int32_t n = 0; n < 10000; ++n) {
    batch.Clear();
    *batch.add_edits()->mutable_put() = message({face(1, n % 7, n)});
    journal.add(batch);
  }
  std::size_t bytes = 0;
  for (const v1::EditBatch& each : journal.batches()) bytes += each.ByteSizeLong();
  EXPECT_LT(bytes, 1000U);
  journal.clear();
  EXPECT_TRUE(journal.batches().empty());
}

TEST(EditJournal, KeepsMeshOperationsInTheirOrder) {
  EditJournal journal;
  v1::EditBatch batch;
  batch.add_edits()->set_mesh("first");
  batch.add_edits()->set_mesh("second");
  journal.add(batch);
  ASSERT_EQ(journal.batches().size(), 1U);
  EXPECT_EQ(journal.batches()[0].edits(0).mesh(), "first");
  EXPECT_EQ(journal.batches()[0].edits(1).mesh(), "second");
}

}  // namespace
}  // namespace footwall::service
