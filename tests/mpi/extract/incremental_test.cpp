#include "engine/extract/incremental.h"

#include <gtest/gtest.h>

#include <map>

#include "engine/extract/registry.h"
#include "mpi/extract/code_of.h"
#include "mpi/extract/random_survey.h"
#include "rounds.h"

namespace footwall::extract {
namespace {

// Keeps faces by identity and makes random changes to them.
class Editor {
 public:
  explicit Editor(RandomSurvey& survey) : survey_(survey) {}

  FaceChanges edit() {
    FaceChanges changes;
    std::map<FaceIdentity, Face> left = faces_;
    const auto some = [&](std::uint64_t most) { return survey_.random() % (most + 1); };
    for (std::uint64_t n = some(3); n > 0 && !left.empty(); --n) {
      const FaceIdentity id = taken(left);
      changes.removed.push_back(id);
      faces_.erase(id);
    }
    for (std::uint64_t n = some(6); n > 0 && !left.empty(); --n) {
      Face face{0, 0, 0, survey_.triangle()};
      const FaceIdentity id = taken(left);
      face = {id.fault, id.owner, id.n, face.triangle};
      changes.changed.push_back(face);
      faces_[id] = face;
    }
    for (std::uint64_t n = faces_.size() < 90 ? some(4) : 0; n > 0; --n) {
      const Face face{next_ % 3, next_ / 7, next_, survey_.triangle()};
      ++next_;
      changes.added.push_back(face);
      faces_[identity_of(face)] = face;
    }
    return changes;
  }

  std::vector<Face> faces() const {
    std::vector<Face> all;
    for (const auto& [id, face] : faces_) all.push_back(face);
    return all;
  }

 private:
  FaceIdentity taken(std::map<FaceIdentity, Face>& left) {
    auto at = left.begin();
    std::advance(at, static_cast<std::ptrdiff_t>(survey_.random() % left.size()));
    const FaceIdentity id = at->first;
    left.erase(at);
    return id;
  }

  RandomSurvey& survey_;
  std::map<FaceIdentity, Face> faces_;
  std::int32_t next_ = 0;
};

bool is_built(std::span<const Row> rows, std::string_view name) {
  return std::any_of(rows.begin(), rows.end(), [&](const Row& row) { return row.name == name && row.built; });
}

class RandomEdits : public testing::TestWithParam<const char*> {};

// After every edit each face that was touched, and from time to time every face, has the numbers that a full
// extraction from scratch gives.
TEST_P(RandomEdits, GiveWhatAFullExtractionGives) {
  const std::string name = GetParam();
  if (!is_built(exchange_rows(), name)) GTEST_SKIP() << name << " is not built";
  const comm::Communicator world(MPI_COMM_WORLD);
  RandomSurvey survey({23, 19, 14}, 11);
  LoadedSurvey loaded(world, survey.dims, survey.reader(), {}, {1, 2});
  LoadedSurvey fresh(world, survey.dims, survey.reader());
  Options options;
  options.exchange = name;
  options.threads = 2;
  Incremental incremental(loaded, survey.max_abs, options);
  Editor editor(survey);
  for (int round = 0; round < rounds(40); ++round) {
    SCOPED_TRACE(testing::Message() << "edit " << round);
    const FaceChanges changes = editor.edit();
    const Update& update = incremental.update(changes);
    std::vector<Face> dirty = changes.added;
    dirty.insert(dirty.end(), changes.changed.begin(), changes.changed.end());
    ASSERT_EQ(update.places.size(), dirty.size());
    ASSERT_EQ(update.freed.size(), changes.removed.size());
    for (std::size_t n = 0; n < dirty.size(); ++n) {
      ASSERT_NE(incremental.face(update.places[n]), nullptr);
      EXPECT_EQ(*incremental.face(update.places[n]), dirty[n]);
    }
    const bool all = round % 20 == 19;
    const std::vector<Face> faces = editor.faces();
    ASSERT_EQ(incremental.size(), faces.size());
    if (all) {
      ASSERT_EQ(incremental.faces(), faces);
    }
    const Result full = fresh.extract({survey.dims, survey.max_abs, all ? faces : dirty}, {});
    if (world.rank() != 0) {
      EXPECT_TRUE(update.statistics.empty());
      continue;
    }
    const std::vector<FaceStatistics>& got = all ? incremental.all_statistics() : update.statistics;
    ASSERT_EQ(got.size(), full.faces.size());
    for (std::size_t n = 0; n < got.size(); ++n)
      ASSERT_TRUE(same_bits(got[n], full.faces[n])) << "face " << n;
  }
}

INSTANTIATE_TEST_SUITE_P(Exchanges, RandomEdits, testing::Values("reduce", "minimum", "push"),
                         [](const auto& chosen) { return std::string(chosen.param); });

// Faces along a wall across the survey, each with a place of its own.
std::vector<Face> wall(int faces, const survey::Index& dims) {
  std::vector<Face> all;
  for (std::int32_t n = 0; n < faces; ++n) {
    const auto i = static_cast<std::int32_t>(n % (dims[0] - 6) * 256);
    const auto j = static_cast<std::int32_t>(n % (dims[1] - 6) * 256);
    all.push_back({1, 0, n, {{{i, j, 0}, {i + 1300, j + 300, 100}, {i + 200, j + 1200, 900}}}});
  }
  return all;
}

TEST(Incremental, CostsWhatWasTouchedWhateverElseIsThere) {
  const comm::Communicator world(MPI_COMM_WORLD);
  const RandomSurvey survey({40, 30, 12}, 3);
  Options options;
  options.exchange = "reduce";
  std::vector<Report> reports;
  for (const int faces : {20, 2000}) {
    LoadedSurvey loaded(world, survey.dims, survey.reader());
    Incremental incremental(loaded, survey.max_abs, options);
    FaceChanges changes;
    changes.added = wall(faces, survey.dims);
    const Update& all = incremental.update(changes);
    EXPECT_EQ(all.report.faces, faces);
    changes = {};
    for (const std::int32_t n : {3, 7, 11}) {
      Face face = wall(20, survey.dims)[static_cast<std::size_t>(n)];
      face.triangle[0].k += 77;
      changes.changed.push_back(face);
    }
    const Update& some = incremental.update(changes);
    const Result alone = loaded.extract({survey.dims, survey.max_abs, changes.changed}, options);
    EXPECT_EQ(some.report.faces, 3);
    EXPECT_EQ(some.report.voxels, alone.report.voxels);
    EXPECT_EQ(some.report.bytes_sent, alone.report.bytes_sent);
    EXPECT_EQ(some.report.messages, alone.report.messages);
    reports.push_back(some.report);
    // An update of nothing sends nothing.
    const Update& nothing = incremental.update({});
    EXPECT_EQ(nothing.report.voxels, 0);
    EXPECT_EQ(nothing.report.messages, 0);
  }
  EXPECT_GT(reports[0].voxels, 0);
  EXPECT_EQ(reports[0].voxels, reports[1].voxels);
  EXPECT_EQ(reports[0].bytes_sent, reports[1].bytes_sent);
  EXPECT_EQ(reports[0].messages, reports[1].messages);
  // Three faces, each with a record of at most 187 bytes from every rank but its own.
  EXPECT_LE(reports[0].messages, 3 * (world.size() - 1));
  EXPECT_LE(reports[0].bytes_sent, 187 * 3 * (world.size() - 1));
}

TEST(Incremental, RefusedAndFailedUpdatesChangeNothing) {
  const comm::Communicator world(MPI_COMM_WORLD);
  const RandomSurvey survey({30, 30, 12}, 5);
  LoadedSurvey loaded(world, survey.dims, survey.reader());
  Incremental incremental(loaded, survey.max_abs, {});
  const std::vector<Face> faces = wall(12, survey.dims);
  FaceChanges first;
  first.added = faces;
  incremental.update(first);
  const std::vector<FaceStatistics> before = incremental.all_statistics();
  const double deviation = incremental.update({}).report.load_deviation;

  Face fresh = faces[0];
  fresh.n = 99;
  std::vector<FaceChanges> wrong(6);
  wrong[0].added = {faces[3]};
  wrong[1].changed = {fresh};
  wrong[2].removed = {identity_of(fresh)};
  wrong[3].changed = {faces[2], faces[2]};
  wrong[4].added = {fresh, faces[5], fresh};
  wrong[5].changed = {faces[4]};
  wrong[5].removed = {identity_of(faces[4])};
  for (const FaceChanges& changes : wrong) {
    EXPECT_EQ(code_of([&] { incremental.update(changes); }), ErrorCode::kInvalid);
  }
  // Cancelled on one rank only, which is known after the last message.
  const JobContext job;
  if (world.rank() == world.size() - 1) job.cancel();
  FaceChanges moved;
  moved.changed = faces;
  for (Face& face : moved.changed) face.triangle[1].k += 300;
  moved.removed = {identity_of(moved.changed.back())};
  moved.changed.pop_back();
  EXPECT_EQ(code_of([&] { incremental.update(moved, job); }), ErrorCode::kCancelled);

  EXPECT_EQ(incremental.faces(), faces);
  const std::vector<FaceStatistics> after = incremental.all_statistics();
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t n = 0; n < after.size(); ++n) EXPECT_TRUE(same_bits(after[n], before[n]));
  EXPECT_EQ(incremental.update({}).report.load_deviation, deviation);

  // And the next one works.
  incremental.update(moved);
  EXPECT_EQ(incremental.size(), faces.size() - 1);
  const Result full = loaded.extract({survey.dims, survey.max_abs, moved.changed}, {});
  const std::vector<FaceStatistics> now = incremental.all_statistics();
  ASSERT_EQ(now.size(), full.faces.size());
  for (std::size_t n = 0; n < now.size(); ++n) EXPECT_TRUE(same_bits(now[n], full.faces[n]));
  EXPECT_DOUBLE_EQ(incremental.update({}).report.load_deviation, full.report.load_deviation);
}

TEST(Incremental, PlacesAreUsedAgain) {
  const comm::Communicator world(MPI_COMM_WORLD);
  const RandomSurvey survey({20, 20, 12}, 6);
  LoadedSurvey loaded(world, survey.dims, survey.reader());
  Incremental incremental(loaded, survey.max_abs, {});
  FaceChanges changes;
  changes.added = wall(8, survey.dims);
  incremental.update(changes);
  const Place place = *incremental.place_of(identity_of(changes.added[4]));
  FaceChanges away;
  away.removed = {identity_of(changes.added[4])};
  EXPECT_EQ(incremental.update(away).freed, std::vector<Place>{place});
  EXPECT_EQ(incremental.face(place), nullptr);
  EXPECT_EQ(incremental.responsible(place), -1);
  EXPECT_FALSE(incremental.place_of(away.removed[0]));
  FaceChanges again;
  again.added = {changes.added[4]};
  again.added[0].n = 50;
  EXPECT_EQ(incremental.update(again).places, std::vector<Place>{place});
  EXPECT_EQ(incremental.place_limit(), 8U);
}

}  // namespace
}  // namespace footwall::extract
