#include "engine/tasks/workload/run_parallel.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "engine/extract/extract.h"
#include "engine/extract/model/shared_model.h"
#include "engine/tasks/workload/make.h"
#include "engine/tasks/workload/values.h"
#include "scratch_folder.h"
#include "storage/base/hash.h"
#include "storage/base/partial_file.h"

namespace footwall::tasks {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kLimit = 10'000'000;

// A folder of rank 0, with a script.
class Place {
 public:
  explicit Place(const comm::Communicator& world) : world_(world) {
    if (world.rank() == 0) folder_.emplace();
  }
  std::filesystem::path script() const { return folder_ ? folder_->path() / "w.fww" : "elsewhere"; }
  std::filesystem::path result() const { return folder_ ? folder_->path() / "r.json" : "elsewhere"; }
  void write(const std::string& text) const {
    if (folder_) write_whole_file(script(), text);
  }
  // Rank 0's answer; null elsewhere.
  Json run(WorkloadRun how) const {
    how.script = script();
    how.result = result();
    run_workload(world_, how, {});
    return folder_ ? Json::parse(read_whole_file(result(), kLimit)) : Json();
  }

 private:
  const comm::Communicator& world_;
  std::optional<ScratchFolder> folder_;
};

// The results of every EXTRACT-ALL, one after the other on this rank alone.
std::uint64_t checksum_alone(const Workload& workload, std::uint64_t seed) {
  const comm::Communicator alone(MPI_COMM_SELF);
  const auto read = [&](const survey::Box& box, std::span<float> values) {
    fill_hashed(workload.size, seed, box, values);
  };
  extract::SharedModel model(alone);
  Hasher hasher;
  for (const WorkloadRepeat& repeat : workload.repeats) {
    for (const WorkloadStep& step : repeat.steps) {
      EXPECT_TRUE(model.apply(step.operations).refusals.empty());
      if (!step.extract) continue;
      const auto faces = model.faces();
      extract::Options options;
      options.exchange = "minimum";
      const std::uint64_t checksum =
          extract::extract_all(alone, {workload.size, 1.0, faces}, options, read).report.checksum;
      hasher.add(std::as_bytes(std::span(&checksum, 1)));
    }
  }
  return hasher.value();
}

WorkloadShape small() {
  WorkloadShape shape;
  shape.size = {23, 19, 31};
  shape.area = 40;
  shape.faces = 60;
  shape.meshes = 5;
  shape.cycles = 3;
  shape.distance = 3;
  shape.repeats = 2;
  return shape;
}

TEST(RunWorkload, GivesTheSameResultsForAnyRanksStrategyAndCache) {
  const comm::Communicator world(MPI_COMM_WORLD);
  const Place place(world);
  if (world.rank() == 0) make_workload(small(), place.script());
  std::string expected;
  if (world.rank() == 0)
    expected = to_hex(checksum_alone(parse_script(read_whole_file(place.script(), kLimit)), 4));
  struct Way {
    const char* exchange;
    bool keep_cache;
  };
  for (const Way& way : {Way{"minimum", false}, Way{"reduce", false}, Way{"push", true}, Way{"block=2", true},
                         Way{"bounding", false}}) {
    WorkloadRun run;
    run.options.exchange = way.exchange;
    run.seed = 4;
    run.keep_cache = way.keep_cache;
    const Json result = place.run(run);
    if (world.rank() != 0) continue;
    EXPECT_EQ(result.at("checksum"), expected) << way.exchange;
    EXPECT_EQ(result.at("ranks"), world.size());
    EXPECT_EQ(result.at("faces"), 65 * 6);
    EXPECT_EQ(result.at("operations").at("extracts"), 6);
    EXPECT_EQ(result.at("operations").at("adds"), 130);
    EXPECT_EQ(result.at("repeats").size(), 2U);
    EXPECT_EQ(result.at("repeats")[0].at("faces"), 65 * 3);
    EXPECT_NE(result.at("repeats")[0].at("checksum"), result.at("repeats")[1].at("checksum"));
    const double slowest = result.at("slowest_rank"), quickest = result.at("quickest_rank");
    EXPECT_GE(slowest, quickest);
    EXPECT_GT(quickest, 0);
    if (world.size() == 1) {
      EXPECT_EQ(result.at("bytes_sent"), 0);
    }
  }
}

TEST(RunWorkload, TheCacheIsEmptiedBetweenRepeatsUnlessKept) {
  const comm::Communicator world(MPI_COMM_WORLD);
  const Place place(world);
  // The same mesh twice, so that the second repeat wants nothing new.
  const std::string repeat = "repeat\ncreate 3 1 0 0 0 5000 0 2000 0 4500 3000 0 1 2\nextract\ndestroy {}\n";
  std::string second = repeat, first = repeat;
  first.replace(first.find("{}"), 2, "0");
  second.replace(second.find("{}"), 2, "1");
  place.write("footwall-workload 1\nsize 20 20 20\n" + first + second);
  WorkloadRun run;
  run.options.exchange = "minimum";
  const Json emptied = place.run(run);
  run.keep_cache = true;
  const Json kept = place.run(run);
  if (world.rank() != 0) return;
  EXPECT_EQ(emptied.at("repeats")[1].at("cache_hits"), 0);
  EXPECT_EQ(emptied.at("repeats")[0].at("bytes_sent"), emptied.at("repeats")[1].at("bytes_sent"));
  if (world.size() == 1) return;
  EXPECT_GT(kept.at("repeats")[1].at("cache_hits"), 0);
  EXPECT_LT(kept.at("repeats")[1].at("bytes_sent"), kept.at("repeats")[0].at("bytes_sent"));
}

TEST(RunWorkload, FailsAlikeOnEveryRank) {
  const comm::Communicator world(MPI_COMM_WORLD);
  const Place place(world);
  const auto error = [&](const std::string& script,
                         const WorkloadRun& run = {}) -> std::pair<ErrorCode, std::string> {
    place.write(script);
    try {
      place.run(run);
    } catch (const comm::AgreedError& e) {
      return {e.code(), e.message()};
    }
    return {ErrorCode::kInternal, "no error"};
  };
  const std::string head = "footwall-workload 1\nsize 20 20 20\nrepeat\n";
  const std::string triangle = "create 3 1 0 0 0 5000 0 2000 0 4500 3000 0 1 2\n";
  EXPECT_EQ(error(head + triangle + "extract\nmove 0 1 9 9 9\nremove 0 7\nextract\n"),
            (std::pair{ErrorCode::kInvalid,
                       std::string("repeat 1, operation 2 after 1 EXTRACT-ALLs: REMOVE-FACES on mesh 0 is "
                                   "refused: there is no mesh vertex 7")}));
  EXPECT_EQ(error(head + "dance\n").first, ErrorCode::kFormat);
  WorkloadRun run;
  run.options.balance = "fair";
  EXPECT_EQ(error(head + triangle, run).first, ErrorCode::kUsage);
}

TEST(RunWorkload, TakesEmptyScriptsAndFacesOutside) {
  const comm::Communicator world(MPI_COMM_WORLD);
  const Place place(world);
  place.write("footwall-workload 1\nsize 1 1 1\nrepeat\nextract\nrepeat\n");
  const Json nothing = place.run({});
  place.write(
      "footwall-workload 1\nsize 3 2 1\nrepeat\ncreate 3 1 90000 0 0 95000 0 0 90000 9000 0 0 1 "
      "2\nextract\n");
  const Json outside = place.run({});
  if (world.rank() != 0) return;
  EXPECT_EQ(nothing.at("voxels"), 0);
  EXPECT_EQ(nothing.at("repeats").size(), 2U);
  EXPECT_EQ(outside.at("faces"), 1);
  EXPECT_EQ(outside.at("voxels"), 0);
}

}  // namespace
}  // namespace footwall::tasks
