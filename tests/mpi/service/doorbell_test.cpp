#include "engine/service/resident/doorbell.h"
#include "engine/service/resident/hosts.h"

#include <gtest/gtest.h>

#include "mpi/service/host_layouts.h"
#include "mpi/service/resident_case.h"

namespace footwall::service {
namespace {

class Doorbells : public ResidentCase {};

TEST_F(Doorbells, EveryRingWakesEveryRankOnceOnAnyHosts) {
  for (const std::vector<int>& host_of : host_layouts(world.size())) {
    Doorbell doorbell(world, folder, host_of);
    constexpr int kRings = 20;
    for (int n = 0; n < kRings; ++n) {
      if (world.rank() == 0) {
        doorbell.ring();
      } else {
        doorbell.wait();
      }
      // What rank 0 says after it.
      const comm::Bytes said =
          world.broadcast(world.rank() == 0 ? comm::Bytes(1, static_cast<std::byte>(n)) : comm::Bytes{}, 0);
      ASSERT_EQ(said.at(0), static_cast<std::byte>(n));
    }
    // Rings before a rank waits are not lost.
    if (world.rank() == 0) {
      for (int n = 0; n < kRings; ++n) doorbell.ring();
    }
    MPI_Barrier(world.get());
    if (world.rank() != 0) {
      for (int n = 0; n < kRings; ++n) doorbell.wait();
    }
    MPI_Barrier(world.get());
  }
}

TEST_F(Doorbells, RanksOfThisMachineAreOfOneHost) {
  EXPECT_EQ(host_of_ranks(world), std::vector<int>(static_cast<std::size_t>(world.size()), 0));
}

TEST_F(Doorbells, AFolderThatIsNotThereIsEveryRanksError) {
  std::string message;
  try {
    const Doorbell doorbell(world, folder / "absent", host_of_ranks(world));
  } catch (const comm::AgreedError& error) {
    message = error.message();
  }
  EXPECT_NE(message.find("absent"), std::string::npos);
}

}  // namespace
}  // namespace footwall::service
