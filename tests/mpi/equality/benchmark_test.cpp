// The workload of seed 004's benchmark 1: 16 meshes of 5,000 added faces of mean area 1,000 voxel^2 in a
// survey of 100 x 100 x 50 voxels; EXTRACT-ALL, every vertex moved by 10 voxels in the mean, EXTRACT-ALL.
//
// What is covered, for each voxelizer: the statistics of every exchange with every balancer on one thread,
// and of every exchange on 2 and 3 threads with one balancer; pillars alternate (ways.h). The second
// extraction finds what the first left in the cache. The bytes of the lapped transform for every exchange
// that moves voxels, with one balancer each; contrast and offset, whose probes take the same way with every
// exchange, in one way.
#include <gtest/gtest.h>

#include <map>

#include "engine/extract/model/shared_model.h"
#include "engine/tasks/workload/make.h"
#include "engine/tasks/workload/values.h"
#include "mpi/equality/expected.h"
#include "mpi/equality/ways.h"
#include "scratch_folder.h"
#include "storage/base/partial_file.h"

namespace footwall::extract {
namespace {

constexpr survey::Index kSize{100, 100, 50};
constexpr std::uint64_t kSeed = 1;
const std::vector<std::string> kStatistics{"mean", "variance", "discontinuity"};

void read(const survey::Box& box, std::span<float> values) {
  tasks::fill_hashed(kSize, kSeed, box, values);
}
float value_at(const survey::Index& p) {
  float value = 0;
  read({p, {p[0] + 1, p[1] + 1, p[2] + 1}}, std::span(&value, 1));
  return value;
}

// The faces of each EXTRACT-ALL of the workload; only its size is less where the test is not thorough.
std::vector<std::vector<Face>> faces_of_workload(const comm::Communicator& world) {
  tasks::WorkloadShape shape;
  shape.size = kSize;
  shape.area = 1000;
  shape.faces = is_thorough() ? 5000 : 48;
  shape.cycles = 2;
  shape.distance = 10;
  shape.repeats = 1;
  const ScratchFolder folder;
  tasks::make_workload(shape, folder / "benchmark1.fww");
  const tasks::Workload workload =
      tasks::parse_script(read_whole_file(folder / "benchmark1.fww", std::size_t{1} << 30));
  SharedModel model(world);
  std::vector<std::vector<Face>> faces;
  for (const tasks::WorkloadStep& step : workload.repeats.at(0).steps) {
    EXPECT_TRUE(model.apply(step.operations).refusals.empty());
    if (step.extract) faces.push_back(model.faces());
  }
  return faces;
}

class Benchmark1 : public testing::TestWithParam<const char*> {
 protected:
  Benchmark1() : world_(MPI_COMM_WORLD), faces_(faces_of_workload(world_)) {
    for (std::size_t n = 0; n < kPillars.size(); ++n)
      surveys_[n] = std::make_unique<LoadedSurvey>(world_, kSize, &read, JobContext(), kPillars[n]);
  }
  std::string voxelizer() const { return GetParam(); }
  std::size_t turn() const { return voxelizer().size(); }
  Input input(std::size_t cycle) const { return {kSize, 1, faces_[cycle]}; }

  // By rank 0 alone, some of it held against definitions.
  std::vector<Expected> expected(const std::vector<std::string>& compute) const {
    std::vector<Expected> all;
    for (std::size_t n = 0; n < faces_.size() && world_.rank() == 0; ++n) {
      all.push_back(alone(input(n), &read, voxelizer(), compute));
      expect_definition(all.back(), input(n), &value_at, voxelizer(), compute, faces_[n].size() / 8);
    }
    return all;
  }

  void check(const std::vector<Way>& ways, const std::vector<std::string>& compute,
             const std::vector<Expected>& want) {
    std::map<std::pair<std::string, std::size_t>, double> deviations;
    for (const Way& way : ways) {
      SCOPED_TRACE(name_of(way));
      LoadedSurvey& survey = *surveys_[way.pillars];
      survey.forget_cache();
      for (std::size_t n = 0; n < faces_.size(); ++n) {
        SCOPED_TRACE(n == 0 ? "first extraction" : "after the move");
        const Result got = survey.extract(input(n), options_of(way, voxelizer(), compute));
        if (world_.rank() == 0) expect_same(got, want[n]);
        deviations[{way.balance, way.pillars}] = got.report.load_deviation;
        // Or the test would not see what it is about.
        if (world_.size() > 1 && n > 0 &&
            (got.report.exchange == "minimum" || got.report.exchange == "push")) {
          EXPECT_GT(got.report.cache_hits, 0);
        }
      }
    }
    for (const auto& [balancer, deviation] : deviations) {
      const auto none = deviations.find({"none", balancer.second});
      if (world_.size() > 1 && none != deviations.end() &&
          (balancer.first == "global=0" || balancer.first == "manhattan=0")) {
        EXPECT_LT(deviation, none->second);  // faces do move
      }
    }
  }

  comm::Communicator world_;
  std::vector<std::vector<Face>> faces_;
  std::array<std::unique_ptr<LoadedSurvey>, kPillars.size()> surveys_;
};

TEST_P(Benchmark1, SameNumbersInEveryWay) {
  check(some_of(covering_ways(turn()), 9, turn()), kStatistics, expected(kStatistics));
}

TEST_P(Benchmark1, SameNumbersOfLappedTransforms) {
  const std::vector<std::string> compute{"variance", "lot"};
  std::vector<Way> ways;
  for (const std::string& exchange : kExchanges) {
    if (exchange == "reduce") continue;
    const std::size_t n = ways.size() + turn();
    ways.push_back({exchange, kBalances[n % kBalances.size()], 1 + static_cast<int>(n % 3), n % 2});
  }
  check(some_of(ways, 5, turn()), compute, expected(compute));
}

TEST_P(Benchmark1, SameNumbersOfProbes) {
  const std::vector<std::string> compute{"discontinuity", "contrast", "offset"};
  check({{"push", "minimal", 2, 1}}, compute, expected(compute));
}

INSTANTIATE_TEST_SUITE_P(Voxelizers, Benchmark1, testing::Values("exact", "rotated", "kaufman"),
                         [](const auto& chosen) { return std::string(chosen.param); });

}  // namespace
}  // namespace footwall::extract
