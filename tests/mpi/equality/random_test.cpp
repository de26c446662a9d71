// Small surveys of random values with nulls, and random faces: degenerate, partly or wholly outside.
//
// What is covered, for each voxelizer, always with an empty cache and, some faces moved, with a warm one:
// - in one survey every exchange with every balancer and both pillars, the threads going round;
// - in another, with contrast and offset, whose probes take their own way, the covering ways of ways.h;
// - in odd ones, with fewer traces than there are ranks or samples than a brick has, the covering ways;
// - incremental updates, in the covering ways.
// Where voxels move, the bytes of whole-face computations are compared, too.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "engine/extract/incremental.h"
#include "mpi/equality/expected.h"
#include "mpi/equality/ways.h"
#include "mpi/extract/random_case.h"

namespace footwall::extract {
namespace {

using Names = std::vector<std::string>;
const Names kMoments{"mean", "variance", "discontinuity"};
const Names kProbes{"mean", "variance", "discontinuity", "contrast", "offset"};
const Names kWhole{"voxels", "lot", "filter"};

Names operator+(Names a, const Names& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// Faces before and after some were moved, what is to be found of them, and the survey as it is read with each
// kind of pillars.
struct Scene {
  Scene(const comm::Communicator& world, const survey::Index& dims, int faces, const std::string& voxelizer,
        const Names& its_folded)
      : folded(its_folded),
        at{random_case(dims, faces, 41), random_case(dims, faces, 41)},
        moved(move_some(at[1], 42)) {
    for (std::size_t n = 0; n < kPillars.size(); ++n)
      surveys[n] = std::make_unique<LoadedSurvey>(world, dims, at[0].reader(), JobContext(), kPillars[n]);
    if (world.rank() != 0) return;
    for (std::size_t n = 0; n < 2; ++n) {
      const auto value = [&](const survey::Index& p) { return at[n].at(p); };
      want[n] = alone(at[n].input(), at[n].reader(), voxelizer, folded + kWhole);
      expect_definition(want[n], at[n].input(), value, voxelizer, folded);
    }
  }
  Names folded;
  std::array<Case, 2> at;
  std::vector<std::size_t> moved;
  std::array<Expected, 2> want;  // at rank 0
  std::array<std::unique_ptr<LoadedSurvey>, kPillars.size()> surveys;
};

class RandomSurveys : public testing::TestWithParam<const char*> {
 protected:
  RandomSurveys() : world_(MPI_COMM_WORLD) {}
  std::string voxelizer() const { return GetParam(); }
  std::size_t turn() const { return voxelizer().size(); }

  void check(const Scene& scene, const std::vector<Way>& ways) {
    std::int64_t hits = 0;
    for (const Way& way : ways) {
      for (const bool whole : {false, true}) {
        // What moves voxels does everything at once.
        if (way.exchange == "reduce" ? whole : way.exchange != "auto" && !whole) continue;
        SCOPED_TRACE(name_of(way) + (whole ? ", whole faces" : ""));
        const Options options = options_of(way, voxelizer(), whole ? scene.folded + kWhole : scene.folded);
        LoadedSurvey& survey = *scene.surveys[way.pillars];
        survey.forget_cache();
        for (std::size_t n = 0; n < 2; ++n) {
          SCOPED_TRACE(n == 0 ? "empty cache" : "warm cache");
          const Result got = survey.extract(scene.at[n].input(), options);
          EXPECT_NE(got.report.exchange, "auto");
          hits += got.report.cache_hits;
          if (world_.rank() != 0) continue;
          expect_same(got, scene.want[n]);
          EXPECT_EQ(got.blobs.size(), whole ? kWhole.size() : 0);
        }
      }
    }
    if (world_.size() > 1 && scene.at[0].values.size() > 10'000) {
      EXPECT_GT(hits, 0);
    }
  }

  comm::Communicator world_;
};

TEST_P(RandomSurveys, SameNumbersInEveryWay) {
  const Scene scene(world_, {43, 38, 29}, is_thorough() ? 60 : 12, voxelizer(), kMoments);
  check(scene, some_of(every_pair(), 13, turn()));
}

TEST_P(RandomSurveys, SameNumbersOfProbes) {
  const Scene scene(world_, {26, 31, 19}, is_thorough() ? 40 : 8, voxelizer(), kProbes);
  check(scene, some_of(covering_ways(turn()), 23, turn()));
}

TEST_P(RandomSurveys, SameNumbersInOddSurveys) {
  std::size_t turn = this->turn();
  for (const survey::Index& dims :
       {survey::Index{1, 1, 1}, {2, 1, 40}, {30, 40, 1}, {150, 5, 9}, {3, 2, 300}}) {
    SCOPED_TRACE(testing::Message() << dims[0] << " x " << dims[1] << " x " << dims[2]);
    const Scene scene(world_, dims, 30, voxelizer(), kMoments);
    ++turn;
    check(scene, some_of(covering_ways(turn), 23, turn));
  }
}

TEST_P(RandomSurveys, SameNumbersByUpdates) {
  const Scene scene(world_, {33, 38, 29}, is_thorough() ? 50 : 12, voxelizer(), kMoments + Names{"contrast"});
  std::array<FaceChanges, 2> changes;
  changes[0].added = scene.at[0].faces;
  for (const std::size_t n : scene.moved) changes[1].changed.push_back(scene.at[1].faces[n]);
  for (const Way& way : some_of(covering_ways(turn()), 23, turn())) {
    SCOPED_TRACE(name_of(way));
    LoadedSurvey& survey = *scene.surveys[way.pillars];
    survey.forget_cache();
    Incremental incremental(
        survey, scene.at[0].max_abs,
        options_of(way, voxelizer(), way.exchange == "reduce" ? scene.folded : scene.folded + kWhole));
    for (std::size_t n = 0; n < 2; ++n) {
      SCOPED_TRACE(n == 0 ? "added" : "changed");
      const Update& update = incremental.update(changes[n]);
      if (world_.rank() != 0) continue;
      std::map<FaceIdentity, FaceStatistics> ordered;
      for (std::size_t f = 0; f < scene.at[n].faces.size(); ++f)
        ordered[identity_of(scene.at[n].faces[f])] = scene.want[n].faces[f];
      std::vector<FaceStatistics> want;
      for (const auto& [identity, statistics] : ordered) want.push_back(statistics);
      expect_same(incremental.all_statistics(), want);
      EXPECT_EQ(update.blobs.size(), way.exchange == "reduce" ? 0 : kWhole.size());
      for (const FaceBlobs& blobs : update.blobs) {
        for (std::size_t f = 0; f + 1 < blobs.offsets.size(); ++f)
          expect_same_blob(blobs, f, scene.want[n].blobs, n == 0 ? f : scene.moved[f]);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Voxelizers, RandomSurveys, testing::Values("exact", "rotated", "kaufman"),
                         [](const auto& chosen) { return std::string(chosen.param); });

}  // namespace
}  // namespace footwall::extract
