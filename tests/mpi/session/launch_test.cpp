#include "engine/session/launch.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "mpi/session/small_job.h"
#include "storage/base/error.h"

namespace footwall::session {
namespace {

class Launch : public testing::Test {
 protected:
  Launch() {
    write_small_job(folder.path());
    // The tests may themselves run in an allocation.
    for (const char* name : {"FOOTWALL_LAUNCHER", "SLURM_JOB_ID", "SLURM_NTASKS", "SLURM_CPUS_PER_TASK"})
      unsetenv(name);
  }
  ~Launch() override { unsetenv("FOOTWALL_LAUNCHER"); }

  std::string run(int ranks, const JobContext& context = {}) {
    LaunchOptions options;
    options.ranks = ranks;
    options.engine = FOOTWALL_ENGINE;
    return run_engine(options, folder.path() / "JOB.json", context);
  }
  Error error_of_run(int ranks, const JobContext& context = {}) {
    try {
      run(ranks, context);
    } catch (const Error& error) {
      return error;
    }
    return Error(ErrorCode::kInternal, "nothing was thrown");
  }
  // A launcher of our own instead of mpirun.
  void launch_with(const std::string& script) {
    const auto path = folder.path() / "launcher";
    std::ofstream(path) << "#!/bin/sh\n" << script << "\n";
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    setenv("FOOTWALL_LAUNCHER", path.c_str(), 1);
  }

  ScratchFolder folder;
};

TEST_F(Launch, GivesTheResultAndItsProgress) {
  std::vector<double> fractions;
  std::vector<std::string> phases;
  const JobContext context([&](const Progress& progress) {
    fractions.push_back(progress.fraction);
    phases.emplace_back(progress.phase);
  });
  const nlohmann::json two = nlohmann::json::parse(run(2, context));
  EXPECT_EQ(two["ranks"], 2);
  ASSERT_FALSE(fractions.empty());
  EXPECT_EQ(fractions.back(), 1);
  EXPECT_NE(std::find(phases.begin(), phases.end(), "read"), phases.end());

  std::filesystem::remove_all(folder.path() / "out");
  const nlohmann::json one = nlohmann::json::parse(run(1));
  EXPECT_EQ(one["checksum"], two["checksum"]);
}

TEST_F(Launch, TheEnginesErrorArrivesAsItWas) {
  std::filesystem::remove(folder.path() / "volume.h5");
  const Error error = error_of_run(3);
  EXPECT_EQ(error.code(), ErrorCode::kNotFound);
  EXPECT_NE(error.message().find("volume.h5"), std::string::npos);
}

TEST_F(Launch, CancelReachesTheRanks) {
  JobContext* running = nullptr;
  JobContext context([&](const Progress&) { running->cancel(); });
  running = &context;
  EXPECT_EQ(error_of_run(2, context).code(), ErrorCode::kCancelled);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out" / "result.json"));
}

TEST_F(Launch, AKilledEngineSaysHowItEnded) {
  launch_with("echo last thing said\nkill -9 $$");
  const Error error = error_of_run(2);
  EXPECT_EQ(error.code(), ErrorCode::kEngine);
  EXPECT_NE(error.message().find("signal 9"), std::string::npos) << error.message();
  EXPECT_NE(error.hint().find("last thing said"), std::string::npos) << error.hint();

  launch_with("exit 7");
  EXPECT_NE(error_of_run(2).message().find("exit status 7"), std::string::npos);
  launch_with("exit 0");
  EXPECT_EQ(error_of_run(2).code(), ErrorCode::kEngine);
}

TEST_F(Launch, ALauncherThatDoesNotExistIsNamed) {
  setenv("FOOTWALL_LAUNCHER", "no-such-launcher -n {ranks}", 1);
  const Error error = error_of_run(2);
  EXPECT_EQ(error.code(), ErrorCode::kEngine);
  EXPECT_NE(error.message().find("no-such-launcher"), std::string::npos);
  EXPECT_NE(error.hint().find("FOOTWALL_LAUNCHER"), std::string::npos);
}

TEST_F(Launch, TheCommandIsConfigurable) {
  setenv("FOOTWALL_LAUNCHER", "srun -n {ranks} -c {threads}", 1);
  LaunchOptions options;
  options.ranks = 5;
  options.threads = 6;
  options.engine = "/opt/footwall-engine";
  EXPECT_EQ(launch_command(options, "/jobs/JOB.json"),
            (std::vector<std::string>{"srun", "-n", "5", "-c", "6", "/opt/footwall-engine", "batch",
                                      "/jobs/JOB.json", "--threads", "6"}));
  EXPECT_GE(usable_cores(), 1);
  EXPECT_LE(default_ranks(), 4);
  EXPECT_EQ(default_threads(), 1);
}

TEST_F(Launch, RanksThatMustMakeRoomCanGoOn) {
  launch_with("exit 75");
  EXPECT_THROW(run(2), Preempted);
}

}  // namespace
}  // namespace footwall::session
