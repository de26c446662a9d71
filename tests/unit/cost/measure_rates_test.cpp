#include "engine/extract/measure_rates.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace footwall::extract {
namespace {

constexpr double MachineRates::*kRates[] = {
    &MachineRates::voxelize, &MachineRates::gather, &MachineRates::fold,   &MachineRates::fold_discontinuity,
    &MachineRates::pack,     &MachineRates::face,   &MachineRates::finish, &MachineRates::balance};

// The least of several: what else runs on the machine only makes them longer.
MachineRates least_rates() {
  MachineRates least = measure_computing(0.05);
  for (int n = 0; n < 3; ++n) {
    const MachineRates more = measure_computing(0.05);
    for (double MachineRates::*rate : kRates) least.*rate = std::min(least.*rate, more.*rate);
  }
  return least;
}

TEST(MeasureRates, ArePositiveAndRepeatable) {
  constexpr double kFactor = 4;  // on a busy machine
  const MachineRates one = least_rates();
  const MachineRates other = least_rates();
  for (double MachineRates::*rate : kRates) {
    EXPECT_GT(one.*rate, 0);
    EXPECT_LT(one.*rate, kFactor * (other.*rate));
    EXPECT_GT(one.*rate, (other.*rate) / kFactor);
  }
  // Which of two things is more work does not depend on the machine.
  EXPECT_GT(one.fold_discontinuity, one.fold);
  EXPECT_GT(one.fold, one.voxelize);
  ASSERT_EQ(one.whole_face.size(), other.whole_face.size());
  for (const MachineRates::WholeFace& each : one.whole_face)
    EXPECT_EQ(one.whole_face_voxel(each.name), each.voxel);
  EXPECT_EQ(one.whole_face_voxel("unheard of"), one.gather);
}

TEST(MeasureRates, FoldingBySeveralThreadsIsCountedForEach) {
  double one = measure_folding(1, 0.02);
  double two = measure_folding(2, 0.02);
  for (int n = 0; n < 6; ++n) {
    one = std::min(one, measure_folding(1, 0.02));
    two = std::min(two, measure_folding(2, 0.02));
  }
  EXPECT_GT(one, 0);
  // Of each thread: never much below one alone, at most a few times as long where they share a core.
  EXPECT_GT(two, one / 2);
  EXPECT_LT(two, one * 10);
}

}  // namespace
}  // namespace footwall::extract
