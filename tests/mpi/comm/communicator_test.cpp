#include "engine/comm/communicator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace footwall::comm {
namespace {

TEST(Communicator, AnErrorOnOneRankIsTheSameErrorOnAll) {
  const Communicator world(MPI_COMM_WORLD);
  for (int culprit = 0; culprit < world.size(); ++culprit) {
    try {
      world.collectively([&] {
        if (world.rank() == culprit) {
          throw Error(ErrorCode::kCorrupt, "chunk " + std::to_string(culprit) + " is gone",
                      "import it again");
        }
      });
      ADD_FAILURE() << "rank " << world.rank() << " went on";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kCorrupt);
      EXPECT_EQ(error.message(), "chunk " + std::to_string(culprit) + " is gone");
      EXPECT_EQ(error.hint(), "import it again");
    }
  }
}

TEST(Communicator, TheLowestRanksErrorWins) {
  const Communicator world(MPI_COMM_WORLD);
  try {
    world.collectively([&]() -> int { throw Error(ErrorCode::kIo, "rank " + std::to_string(world.rank())); });
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.message(), "rank 0");
  }
}

TEST(Communicator, ForeignExceptionsBecomeErrors) {
  const Communicator world(MPI_COMM_WORLD);
  const auto code_of = [&](auto thrower) {
    try {
      world.collectively(thrower);
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::kUsage;
  };
  const bool last = world.rank() == world.size() - 1;
  EXPECT_EQ(code_of([&] {
              if (last) throw std::bad_alloc();
            }),
            ErrorCode::kMemory);
  EXPECT_EQ(code_of([&] {
              if (last) throw std::runtime_error("odd");
            }),
            ErrorCode::kInternal);
  EXPECT_EQ(code_of([&] {
              if (last) throw 7;
            }),
            ErrorCode::kInternal);
}

TEST(Communicator, EachRankKeepsItsOwnValue) {
  const Communicator world(MPI_COMM_WORLD);
  EXPECT_EQ(world.collectively([&] { return world.rank() * 10; }), world.rank() * 10);
  const auto movable = world.collectively([&] { return std::make_unique<int>(world.rank()); });
  EXPECT_EQ(*movable, world.rank());
}

TEST(Communicator, ExchangeDeliversEveryByteAndCountsThem) {
  Communicator world(MPI_COMM_WORLD);
  const auto length = [](int from, int to) {
    return static_cast<std::size_t>((from * 7 + to * 3) % 5 * 1000);
  };
  std::vector<Bytes> outgoing;
  std::int64_t bytes = 0;
  std::int64_t messages = 0;
  for (int to = 0; to < world.size(); ++to) {
    outgoing.emplace_back(length(world.rank(), to), static_cast<std::byte>(world.rank() * 16 + to));
    if (to == world.rank()) continue;
    bytes += 8 + static_cast<std::int64_t>(outgoing.back().size());
    messages += outgoing.back().empty() ? 1 : 2;
  }
  const std::vector<Bytes> incoming = world.exchange(std::move(outgoing));
  ASSERT_EQ(incoming.size(), static_cast<std::size_t>(world.size()));
  for (int from = 0; from < world.size(); ++from) {
    EXPECT_EQ(incoming[static_cast<std::size_t>(from)],
              Bytes(length(from, world.rank()), static_cast<std::byte>(from * 16 + world.rank())));
  }
  EXPECT_EQ(world.traffic().bytes, bytes);
  EXPECT_EQ(world.traffic().messages, messages);
}

TEST(Communicator, KnownMessagesAreUnderWayWhileTheRankDoesSomethingElse) {
  Communicator world(MPI_COMM_WORLD);
  const int next = (world.rank() + 1) % world.size();
  const int last = (world.rank() + world.size() - 1) % world.size();
  for (int round = 0; round < 3; ++round) {  // memory and requests are used again
    const Bytes sent(static_cast<std::size_t>(1000 * world.rank() + round), std::byte(world.rank() + round));
    Bytes room(std::size_t{1000} * 8);
    std::vector<KnownOutgoing> outgoing;
    std::vector<KnownIncoming> incoming;
    if (world.size() > 1) {
      outgoing.push_back({next, sent, room.size()});
      incoming.push_back({last, room});
    }
    world.progress_known();  // nothing is under way: nothing happens
    world.begin_known(outgoing, incoming);
    for (int look = 0; look < 100; ++look) world.progress_known();
    world.end_known(incoming);
    for (const KnownIncoming& from : incoming) {
      EXPECT_EQ(from.received, static_cast<std::size_t>(1000 * last + round));
      EXPECT_TRUE(std::all_of(room.begin(), room.begin() + static_cast<std::ptrdiff_t>(from.received),
                              [&](std::byte each) { return each == std::byte(last + round); }));
    }
  }
  EXPECT_EQ(world.traffic().messages, world.size() > 1 ? 3 : 0);
}

TEST(Communicator, AWrongArgumentOnOneRankDoesNotHangTheOthers) {
  Communicator world(MPI_COMM_WORLD);
  const int ranks = world.rank() == world.size() - 1 ? world.size() + 1 : world.size();
  EXPECT_THROW(world.exchange(std::vector<Bytes>(static_cast<std::size_t>(ranks))), Error);
}

TEST(Communicator, TheCartesianOneHasTheGridsOrder) {
  const Communicator world(MPI_COMM_WORLD);
  const RankGrid grid({40, 30, 5}, world.size());
  const Communicator cartesian(world, grid);
  int place[2] = {-1, -1};
  check(MPI_Cart_coords(cartesian.get(), cartesian.rank(), 2, place), "MPI_Cart_coords");
  EXPECT_EQ(place[0] * grid.parts()[1] + place[1], world.rank());
  const survey::Box box = grid.box(cartesian.rank());
  if (!box.empty()) {
    EXPECT_EQ(grid.owner(box.lo), cartesian.rank());
  }
}

TEST(Communicator, BroadcastAndReductions) {
  const Communicator world(MPI_COMM_WORLD);
  const int root = world.size() - 1;
  const Bytes sent = world.rank() == root ? Bytes(5000, std::byte{42}) : Bytes{};
  EXPECT_EQ(world.broadcast(sent, root), Bytes(5000, std::byte{42}));
  EXPECT_EQ(world.sum(std::int64_t{world.rank()}), std::int64_t{world.size()} * (world.size() - 1) / 2);
  EXPECT_EQ(world.maximum(static_cast<double>(world.rank())), world.size() - 1);
}

}  // namespace
}  // namespace footwall::comm
