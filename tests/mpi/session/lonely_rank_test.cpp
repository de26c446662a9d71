#include "engine/session/lonely_rank.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "storage/base/error.h"

namespace footwall::session {
namespace {

class LonelyRank : public testing::Test {
 protected:
  LonelyRank() { clear(); }
  ~LonelyRank() override { clear(); }
  static void clear() {
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS", "SLURM_NTASKS"})
      unsetenv(name);
  }
};

TEST_F(LonelyRank, AProgramStartedByItselfIsWelcome) {
  EXPECT_NO_THROW(refuse_lonely_rank(1));
  setenv("SLURM_NTASKS", "1", 1);
  EXPECT_NO_THROW(refuse_lonely_rank(1));
  setenv("SLURM_NTASKS", "nonsense", 1);
  EXPECT_NO_THROW(refuse_lonely_rank(1));
}

TEST_F(LonelyRank, SeveralThatDoNotKnowOfEachOtherAreRefused) {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS", "SLURM_NTASKS"}) {
    clear();
    setenv(name, "3", 1);
    EXPECT_THROW(refuse_lonely_rank(1), Error) << name;
    EXPECT_NO_THROW(refuse_lonely_rank(3)) << name;
  }
}

TEST_F(LonelyRank, TheLauncherKnowsBetterThanTheAllocation) {
  setenv("SLURM_NTASKS", "8", 1);
  setenv("OMPI_COMM_WORLD_SIZE", "1", 1);  // mpirun -n 1 inside an allocation of eight
  EXPECT_NO_THROW(refuse_lonely_rank(1));
  clear();
  setenv("SLURM_NTASKS", "8", 1);
  setenv("SLURM_STEP_NUM_TASKS", "1", 1);  // srun -n 1
  EXPECT_NO_THROW(refuse_lonely_rank(1));
}

}  // namespace
}  // namespace footwall::session
