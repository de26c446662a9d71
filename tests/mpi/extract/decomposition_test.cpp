// Ranks, pillars and threads decide who does what, and no number.
#include <gtest/gtest.h>

#include <numeric>

#include "engine/extract/balance/area.h"
#include "engine/extract/extract.h"
#include "mpi/extract/random_survey.h"

namespace footwall::extract {
namespace {

std::vector<Face> some_faces(RandomSurvey& survey, int count) {
  std::vector<Face> faces;
  for (std::int32_t n = 0; n < count; ++n) faces.push_back({n % 4, n / 4, n, survey.triangle()});
  return faces;
}

TEST(Decomposition, InterleavedPillarsGiveTheSameNumbers) {
  const comm::Communicator world(MPI_COMM_WORLD);
  RandomSurvey survey({29, 31, 18}, 21);
  const std::vector<Face> faces = some_faces(survey, 120);
  const Input input{survey.dims, survey.max_abs, faces};
  const Result plain = extract_all(world, input, {}, survey.reader());
  for (const std::array<int, 2> pillars : {std::array<int, 2>{2, 1}, std::array<int, 2>{1, 3},
                                           std::array<int, 2>{2, 2}, std::array<int, 2>{7, 5}}) {
    for (const std::string exchange : {"reduce", "minimum", "push"}) {
      SCOPED_TRACE(testing::Message() << exchange << " with " << pillars[0] << " x " << pillars[1]);
      Options options;
      options.pillars = pillars;
      options.exchange = exchange;
      const Result cut = extract_all(world, input, options, survey.reader());
      EXPECT_EQ(cut.report.checksum, plain.report.checksum);
      EXPECT_EQ(cut.report.voxels, plain.report.voxels);
      ASSERT_EQ(cut.faces.size(), plain.faces.size());
      for (std::size_t n = 0; n < cut.faces.size(); ++n) EXPECT_TRUE(same_bits(cut.faces[n], plain.faces[n]));
    }
  }
}

TEST(Decomposition, ThreadsGiveTheSameNumbers) {
  const comm::Communicator world(MPI_COMM_WORLD);
  RandomSurvey survey({24, 20, 16}, 22);
  const std::vector<Face> faces = some_faces(survey, 150);
  const Input input{survey.dims, survey.max_abs, faces};
  LoadedSurvey loaded(world, survey.dims, survey.reader());
  const std::uint64_t one = loaded.extract(input, {}).report.checksum;
  for (const int threads : {2, 3, 1}) {  // the buffers of one number of threads serve another
    Options options;
    options.threads = threads;
    EXPECT_EQ(loaded.extract(input, options).report.checksum, one);
    options.compute = {"variance"};
    loaded.extract(input, options);
  }
  EXPECT_EQ(loaded.extract(input, {}).report.checksum, one);
}

TEST(ReportOfExtraction, TellsLoadsAndSeconds) {
  const comm::Communicator world(MPI_COMM_WORLD);
  RandomSurvey survey({24, 20, 16}, 23);
  const std::vector<Face> faces = some_faces(survey, 60);
  const Report report = extract_all(world, {survey.dims, survey.max_abs, faces}, {}, survey.reader()).report;
  ASSERT_EQ(report.loads.size(), static_cast<std::size_t>(world.size()));
  const std::vector<FixedArea> areas = fixed_areas(faces);
  EXPECT_EQ(std::accumulate(report.loads.begin(), report.loads.end(), FixedArea{0}),
            std::accumulate(areas.begin(), areas.end(), FixedArea{0}));
  EXPECT_EQ(report.load_deviation, load_deviation(report.loads));
  if (world.size() > 1) {
    EXPECT_GT(report.load_deviation, 0);
  }
  for (const auto& [slowest, quickest] : {std::pair{report.seconds.read, report.quickest.read},
                                          std::pair{report.seconds.voxelize, report.quickest.voxelize},
                                          std::pair{report.seconds.exchange, report.quickest.exchange},
                                          std::pair{report.seconds.compute, report.quickest.compute},
                                          std::pair{report.seconds.total, report.quickest.total}}) {
    EXPECT_GE(quickest, 0);
    EXPECT_GE(slowest, quickest);
  }
  EXPECT_GE(report.seconds.total, report.seconds.read + report.quickest.voxelize);
}

}  // namespace
}  // namespace footwall::extract
