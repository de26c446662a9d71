#include "engine/comm/calibrate.h"

#include <gtest/gtest.h>

#include "engine/extract/cost/rates_file.h"
#include "engine/extract/machine_rates.h"
#include "scratch_folder.h"

namespace footwall::extract {
namespace {

TEST(Calibrate, LinksArePositiveAndAlikeOnAllRanks) {
  const comm::Communicator world(MPI_COMM_WORLD);
  const comm::LinkRates rates = comm::measure_links(world, 0.02);
  for (const double rate : {rates.alpha, rates.overhead, rates.byte}) {
    EXPECT_EQ(rate, world.maximum(rate));
    EXPECT_EQ(rate, -world.maximum(-rate));
    if (world.size() == 1) {
      EXPECT_EQ(rate, 0);
    } else {
      EXPECT_GT(rate, 0);
      EXPECT_LT(rate, 1);
    }
  }
}

TEST(Calibrate, WhatWasMeasuredIsKeptForTheNextTime) {
  const comm::Communicator world(MPI_COMM_WORLD);
  const ScratchFolder scratch;  // of this rank: only rank 0's is used
  const MachineRates measured = machine_rates(world, scratch.path());
  const MachineRates kept = machine_rates(world, scratch.path());
  EXPECT_EQ(measured, kept);
  EXPECT_EQ(measured.ranks, world.size());
  EXPECT_GE(measured.cores, 1);
  const std::string text = to_text(measured);
  const auto* raw = reinterpret_cast<const std::byte*>(text.data());
  EXPECT_EQ(world.broadcast({raw, raw + text.size()}, 0), comm::Bytes(raw, raw + text.size()));
  // Another time, another measurement.
  EXPECT_NE(measured_rates(world, scratch.path()).voxelize, measured.voxelize);
}

}  // namespace
}  // namespace footwall::extract
