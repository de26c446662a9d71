#include "engine/tasks/workload/run.h"

#include <gtest/gtest.h>

#include "scratch_folder.h"
#include "storage/base/error.h"
#include "storage/base/partial_file.h"

namespace footwall::tasks {
namespace {

TEST(Run, HandsEveryOptionToTheEngine) {
  WorkloadRunOptions options;
  options.script = "/scripts/a.fww";
  options.launch.threads = 3;
  options.options.exchange = "minimum";
  options.options.compute = {"mean", "variance"};
  options.options.pillars = {2, 4};
  options.options.cache_bytes = 12;
  options.options.snr = 40.5;
  options.options.phases_apart = true;
  options.seed = 9;
  options.keep_cache = true;
  const std::vector<std::string> expected{"workload",       "/scripts/a.fww",
                                          "--result",       "/tmp/r.json",
                                          "--exchange",     "minimum",
                                          "--balance",      "auto",
                                          "--voxelizer",    "exact",
                                          "--compute",      "mean,variance",
                                          "--threads",      "3",
                                          "--interleave",   "2x4",
                                          "--memory",       "12",
                                          "--snr",          "40.5",
                                          "--seed",         "9",
                                          "--phases-apart", "--keep-cache"};
  EXPECT_EQ(engine_words(options, "/tmp/r.json"), expected);
}

TEST(Run, RefusesWithoutStartingRanks) {
  const ScratchFolder folder;
  WorkloadRunOptions options;
  options.launch.engine = "/nowhere/footwall-engine";  // it would be kEngine if it came so far
  const auto code = [&] {
    try {
      run_workload_engine(options, {});
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::kInternal;
  };
  options.script = folder.path() / "missing.fww";
  EXPECT_EQ(code(), ErrorCode::kNotFound);
  options.script = folder.path() / "there.fww";
  write_whole_file(options.script, "footwall-workload 1\nsize 1 1 1\n");
  options.options.balance = "fair";
  EXPECT_EQ(code(), ErrorCode::kUsage);
}

}  // namespace
}  // namespace footwall::tasks
