#include "engine/session/self_check.h"

#include <gtest/gtest.h>

#include <fstream>

#include "scratch_folder.h"

namespace footwall::session {
namespace {

class SelfCheck : public testing::Test {
 protected:
  SelfCheck() { unsetenv("FOOTWALL_LAUNCHER"); }
  ~SelfCheck() override { unsetenv("FOOTWALL_LAUNCHER"); }

  EngineFacts check(int ranks, const std::filesystem::path& folder) const {
    LaunchOptions options;
    options.ranks = ranks;
    options.threads = 1;
    options.engine = FOOTWALL_ENGINE;
    return check_engine(options, folder, {});
  }
  void launch_with(const std::string& script) const {
    const auto path = scripts_ / "launcher";
    std::ofstream(path) << "#!/bin/sh\n" << script << "\n";
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    setenv("FOOTWALL_LAUNCHER", path.c_str(), 1);
  }

  ScratchFolder folder_;
  ScratchFolder scripts_;
};

TEST_F(SelfCheck, TheRanksWorkTogetherAndLeaveNothing) {
  const EngineFacts facts = check(3, folder_.path());
  EXPECT_EQ(facts.ranks, 3);
  EXPECT_EQ(facts.mpi_library.size(), 1U);
  EXPECT_EQ(facts.hdf5_trouble, "");
  EXPECT_EQ(facts.hdf5_compiled, facts.hdf5_running);
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(SelfCheck, AFolderThatCannotHoldTheFileIsSaid) {
  const EngineFacts facts = check(2, folder_ / "nowhere");
  EXPECT_EQ(facts.ranks, 2);
  EXPECT_NE(facts.hdf5_trouble.find("nowhere"), std::string::npos) << facts.hdf5_trouble;
}

TEST_F(SelfCheck, ALauncherThatFailsIsQuoted) {
  launch_with("echo no such network\nexit 3");
  try {
    check(2, folder_.path());
    FAIL() << "expected an error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kEngine);
    EXPECT_NE(std::string(error.what()).find("no such network"), std::string::npos) << error.what();
  }
}

TEST_F(SelfCheck, ALauncherOfAnotherMpiGivesWorldsOfOne) {
  launch_with("\"$@\" && exec \"$@\"");
  EXPECT_EQ(check(2, folder_.path()).ranks, 1);
}

TEST_F(SelfCheck, FactsComeBackAsTheyWere) {
  EngineFacts facts;
  facts.ranks = 2;
  facts.mpi_library = {"A \"quoted\" one", "B"};
  facts.hdf5_trouble = std::string("x");
  const EngineFacts back = engine_facts_from(to_json(facts));
  EXPECT_EQ(back.mpi_library, facts.mpi_library);
  EXPECT_EQ(back.hdf5_trouble, "x");
  EXPECT_THROW(engine_facts_from("{\"engine\":{}}"), Error);
  EXPECT_THROW(engine_facts_from("rubbish"), Error);
}

}  // namespace
}  // namespace footwall::session
