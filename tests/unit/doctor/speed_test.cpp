#include "engine/tasks/doctor/speed.h"

#include <gtest/gtest.h>

#include "scratch_folder.h"
#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

constexpr std::int64_t kMiB = std::int64_t{1} << 20;

TEST(Speed, NeverTakesMoreThanATenthOfTheDisk) {
  EXPECT_EQ(bytes_to_measure(0), 0);
  EXPECT_EQ(bytes_to_measure(100 * kMiB), 0);
  EXPECT_EQ(bytes_to_measure(1001 * kMiB), 100 * kMiB);
  EXPECT_EQ(bytes_to_measure(std::int64_t{1} << 50), 256 * kMiB);
}

TEST(Speed, LeavesNothingBehind) {
  const ScratchFolder folder;
  const Speed speed = measure_speed(folder.path(), 8 * kMiB, {});
  EXPECT_EQ(speed.bytes, 8 * kMiB);
  EXPECT_GT(speed.write_mb_s, 0);
  EXPECT_GT(speed.read_mb_s, 0);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  const JobContext job;
  job.cancel();
  EXPECT_THROW(measure_speed(folder.path(), 8 * kMiB, job), Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace footwall::tasks
