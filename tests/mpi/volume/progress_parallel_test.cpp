#include "storage/volume/progress_parallel.h"

#include <gtest/gtest.h>

namespace footwall::volume {
namespace {

TEST(CommonProgress, EndsWithTheSumsOfAllHoweverUnequalTheirWork) {
  const OwnCommunicator comm(MPI_COMM_WORLD);
  for (const bool last_is_slow : {true, false}) {
    CommonProgress progress(comm);
    const int place = last_is_slow ? comm.rank() : comm.size() - 1 - comm.rank();
    const std::int64_t mine = 100 * place;
    std::int64_t before = 0;
    for (std::int64_t n = 0; n < mine; ++n) {
      progress.tell(n);
      EXPECT_GE(progress.done(), before);
      before = progress.done();
    }
    progress.finish(mine, true, [&] {
      EXPECT_GE(progress.done(), before);
      before = progress.done();
      return true;
    });
    EXPECT_FALSE(progress.failed());
    EXPECT_EQ(progress.done(), 50 * comm.size() * (comm.size() - 1));
  }
}

// Would not end if those at work had to finish before they hear of it.
TEST(CommonProgress, AFailureReachesThoseAtWork) {
  const OwnCommunicator comm(MPI_COMM_WORLD);
  for (int bad = 0; bad < comm.size(); ++bad) {
    CommonProgress progress(comm);
    if (comm.rank() != bad) {
      while (!progress.failed()) progress.tell(1);
    }
    progress.finish(1, comm.rank() != bad, [] { return true; });
    EXPECT_TRUE(progress.failed());
  }
}

TEST(CommonProgress, WhoWaitsForOthersMayFail) {
  const OwnCommunicator comm(MPI_COMM_WORLD);
  if (comm.size() == 1) return;  // nobody to wait for
  CommonProgress progress(comm);
  if (comm.rank() == comm.size() - 1) {
    while (!progress.failed()) progress.tell(1);
  }
  progress.finish(1, true, [&] { return comm.rank() != 0; });
  EXPECT_TRUE(progress.failed());
}

}  // namespace
}  // namespace footwall::volume
