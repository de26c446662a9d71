#include "engine/tasks/doctor/engine_check.h"

#include <gtest/gtest.h>

namespace footwall::tasks {
namespace {

session::EngineFacts sound() {
  session::EngineFacts facts;
  facts.ranks = 2;
  facts.mpi_library = {"Open MPI v4.1.4"};
  facts.mpi_compiled = "Open MPI 4.1.4";
  facts.mpi_standard = "3.1";
  facts.hdf5_compiled = facts.hdf5_running = "1.10.8";
  return facts;
}

TEST(EngineCheck, ASoundEngineIsOk) {
  EXPECT_EQ(ranks_finding(sound(), 2, 0.5).verdict, Verdict::kOk);
  EXPECT_EQ(mpi_finding(sound()).verdict, Verdict::kOk);
  EXPECT_EQ(hdf5_finding(sound()).verdict, Verdict::kOk);
}

TEST(EngineCheck, ALauncherOfAnotherMpiIsNamed) {
  auto facts = sound();
  facts.ranks = 1;
  const Finding finding = ranks_finding(facts, 2, 0.5);
  EXPECT_EQ(finding.verdict, Verdict::kFailed);
  EXPECT_NE(finding.hint.find("FOOTWALL_LAUNCHER"), std::string::npos);
}

TEST(EngineCheck, LibrariesThatDisagreeFail) {
  auto facts = sound();
  facts.mpi_library = {"Open MPI v4.1.4", "Open MPI v4.1.5"};
  EXPECT_EQ(mpi_finding(facts).verdict, Verdict::kFailed);
  facts.mpi_library = {"MPICH Version:      4.0.2"};
  EXPECT_EQ(mpi_finding(facts).verdict, Verdict::kFailed);
  facts.mpi_compiled = "MPICH 4.0.2";
  EXPECT_EQ(mpi_finding(facts).verdict, Verdict::kOk);
  facts.hdf5_running = "1.12.0";
  EXPECT_EQ(hdf5_finding(facts).verdict, Verdict::kFailed);
  facts.hdf5_trouble = "no room";
  EXPECT_EQ(hdf5_finding(facts).what, "no room");
}

}  // namespace
}  // namespace footwall::tasks
