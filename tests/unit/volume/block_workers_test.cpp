#include "storage/volume/block_workers.h"

#include <gtest/gtest.h>

#include <atomic>

#include "storage/base/error.h"

namespace footwall::volume {
namespace {

TEST(BlockWorkers, EverySubmittedSlotIsWorkedOnOnceAndNeverTwiceAtOnce) {
  constexpr std::size_t kSlots = 3;
  std::vector<std::atomic<int>> busy(kSlots);
  std::vector<int> input(kSlots);
  std::atomic<long> sum{0};
  std::atomic<bool> clashed{false};
  BlockWorkers workers(4, kSlots, [&](std::size_t slot, std::size_t worker) {
    if (busy[slot].fetch_add(1) != 0 || worker >= 4) clashed = true;
    sum += input[slot];
    busy[slot].fetch_sub(1);
  });
  for (int n = 1; n <= 1000; ++n) {
    const std::size_t slot = workers.take_free();
    if (busy[slot].load() != 0) clashed = true;
    input[slot] = n;
    workers.submit(slot);
  }
  workers.finish();
  EXPECT_EQ(sum.load(), 500500);
  EXPECT_FALSE(clashed.load());
}

TEST(BlockWorkers, AWorkersErrorReachesTheProducer) {
  BlockWorkers workers(
      2, 2, [](std::size_t, std::size_t) -> void { throw Error(ErrorCode::kIo, "the disk is full"); });
  try {
    for (int n = 0; n < 10; ++n) workers.submit(workers.take_free());
    workers.finish();
    FAIL() << "no error came";
  } catch (const Error& error) {
    EXPECT_EQ(error.message(), "the disk is full");
  }
}

TEST(BlockWorkers, GivingUpDoesNotHang) {
  std::atomic<int> done{0};
  {
    BlockWorkers workers(1, 4, [&](std::size_t, std::size_t) { ++done; });
    for (int n = 0; n < 4; ++n) workers.submit(workers.take_free());
  }
  EXPECT_LE(done.load(), 4);
}

}  // namespace
}  // namespace footwall::volume
