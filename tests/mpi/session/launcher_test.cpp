#include "engine/session/launcher.h"

#include <gtest/gtest.h>
#include <mpi.h>  // only for the name of the library

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "scratch_folder.h"
#include "storage/base/error.h"

namespace footwall::session {
namespace {

class LauncherChoice : public testing::Test {
 protected:
  LauncherChoice() { clear(); }
  ~LauncherChoice() override { clear(); }

  static void clear() {
    for (const char* name :
         {"FOOTWALL_LAUNCHER", "SLURM_JOB_ID", "SLURM_NTASKS", "SLURM_CPUS_PER_TASK", "SLURM_STEP_ID",
          "SLURM_STEP_NUM_TASKS", "SLURM_JOB_NUM_NODES", "SLURM_MEM_PER_CPU", "PBS_NODEFILE"})
      unsetenv(name);
  }
  static bool has(const Launcher& launcher, const std::string& word) {
    return std::find(launcher.words.begin(), launcher.words.end(), word) != launcher.words.end();
  }
};

TEST_F(LauncherChoice, ThePluginIsFoundInEveryFormOfTheList) {
  EXPECT_EQ(mpi_plugin_in("MPI plugin types are...\n\tnone\n\tpmi2\n\tpmix\n"
                          "specific pmix plugin versions available: pmix_v4"),
            "pmix");
  EXPECT_EQ(mpi_plugin_in("srun: MPI types are...\nsrun: none\nsrun: pmix_v3\nsrun: pmi2\n"), "pmix");
  EXPECT_EQ(mpi_plugin_in("MPI plugin types are...\n\tcray_shasta\n\tpmi2\n"), "pmi2");
  EXPECT_EQ(mpi_plugin_in("MPI plugin types are...\n\tnone\n"), std::nullopt);
  EXPECT_EQ(mpi_plugin_in("srun: error: pmix\nsrun: fatal: no configuration of pmix\n"), std::nullopt);
  EXPECT_EQ(mpi_plugin_in(""), std::nullopt);
}

TEST_F(LauncherChoice, WithoutABatchSystemMpirunKeepsItsFilesInOurFolder) {
  const Launcher launcher = choose_launcher(3, 2, "/dev/shm/ours");
  EXPECT_EQ(std::filesystem::path(launcher.words.front()).filename().string().substr(0, 3), "mpi");
  EXPECT_TRUE(has(launcher, "3"));
#ifdef OPEN_MPI
  EXPECT_TRUE(has(launcher, "/dev/shm/ours"));
  // On several hosts the folder is there on one of them only.
  setenv("PBS_NODEFILE", "/hosts", 1);
  EXPECT_FALSE(has(choose_launcher(3, 2, "/dev/shm/ours"), "/dev/shm/ours"));
#endif
}

TEST_F(LauncherChoice, AnotherMpisLauncherInThePathIsNotTaken) {
  const ScratchFolder folder;
  for (const char* name : {"mpirun", "mpiexec"}) {
    std::ofstream(folder / name) << "#!/bin/sh\n";
    std::filesystem::permissions(folder / name, std::filesystem::perms::owner_all);
  }
  const std::string before = std::getenv("PATH");
  setenv("PATH", (folder.path().string() + ":" + before).c_str(), 1);
  EXPECT_EQ(choose_launcher(2, 1, {}).words.front(), FOOTWALL_MPIEXEC);
  setenv("PATH", before.c_str(), 1);
}

TEST_F(LauncherChoice, AnAllocationIsReadAsFarAsItMakesSense) {
  EXPECT_FALSE(current_allocation().slurm);
  setenv("SLURM_JOB_ID", "12", 1);
  setenv("SLURM_NTASKS", "5", 1);
  setenv("SLURM_CPUS_PER_TASK", "many", 1);
  setenv("SLURM_MEM_PER_CPU", "2000", 1);
  const Allocation allocation = current_allocation();
  EXPECT_TRUE(allocation.slurm);
  EXPECT_FALSE(allocation.in_step);
  EXPECT_EQ(allocation.tasks, 5);
  EXPECT_EQ(allocation.cpus_per_task, std::nullopt);
  EXPECT_EQ(allocation.megabytes_per_cpu, 2000);
}

TEST_F(LauncherChoice, OneOfSeveralTasksStartsNothing) {
  setenv("SLURM_JOB_ID", "12", 1);
  setenv("SLURM_STEP_ID", "0", 1);
  setenv("SLURM_STEP_NUM_TASKS", "4", 1);
  EXPECT_THROW(choose_launcher(2, 1, {}), Error);
}

TEST_F(LauncherChoice, OurWordsReplaceAllOthers) {
  setenv("FOOTWALL_LAUNCHER", "  jsrun -n {ranks}  -c{threads} ", 1);
  setenv("SLURM_JOB_ID", "12", 1);
  EXPECT_EQ(choose_launcher(5, 6, {}).words, (std::vector<std::string>{"jsrun", "-n", "5", "-c6"}));
}

}  // namespace
}  // namespace footwall::session
