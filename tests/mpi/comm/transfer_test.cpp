#include "engine/comm/transfer.h"

#include <gtest/gtest.h>

#include <set>

namespace footwall::comm {
namespace {

std::size_t length(int from, int to) {
  return static_cast<std::size_t>((from * 7 + to * 3) % 4) * 40000;  // some of them nothing
}

// Everybody to everybody, of lengths that both sides know.
struct Talk {
  explicit Talk(const Communicator& world) {
    for (int other = 0; other < world.size(); ++other) {
      const bool self = other == world.rank();
      outgoing.emplace_back(self ? 0 : length(world.rank(), other),
                            static_cast<std::byte>(world.rank() * 16 + other));
      incoming.emplace_back(self ? 0 : length(other, world.rank()));
    }
  }
  void post(Transfer& transfer) {
    for (std::size_t r = 0; r < incoming.size(); ++r) transfer.receive(static_cast<int>(r), incoming[r]);
    for (std::size_t r = 0; r < outgoing.size(); ++r) transfer.send(static_cast<int>(r), outgoing[r]);
  }
  void expect_here(const Communicator& world) const {
    for (int from = 0; from < world.size(); ++from) {
      const Bytes& got = incoming[static_cast<std::size_t>(from)];
      EXPECT_EQ(got, Bytes(got.size(), static_cast<std::byte>(from * 16 + world.rank())));
    }
  }
  std::vector<Bytes> outgoing;
  std::vector<Bytes> incoming;
};

TEST(Transfer, DeliversWhileTheRankLooksAndCountsWhatItSends) {
  Communicator world(MPI_COMM_WORLD);
  Talk talk(world);
  std::int64_t bytes = 0;
  std::int64_t messages = 0;
  for (const Bytes& each : talk.outgoing) {
    bytes += static_cast<std::int64_t>(each.size());
    messages += each.empty() ? 0 : 1;
  }
  Transfer transfer(world, 2);
  talk.post(transfer);
  while (!transfer.progress()) {
  }
  talk.expect_here(world);
  EXPECT_EQ(world.traffic().bytes, bytes);
  EXPECT_EQ(world.traffic().messages, messages);
}

TEST(Transfer, NamesEverySenderOnceWhenItsMessageIsHere) {
  Communicator world(MPI_COMM_WORLD);
  Talk talk(world);
  Transfer transfer(world, 2);
  talk.post(transfer);
  std::multiset<int> told;
  std::multiset<int> expected;
  while (const std::optional<int> from = transfer.next_received()) {
    told.insert(*from);
    const Bytes& got = talk.incoming[static_cast<std::size_t>(*from)];
    EXPECT_EQ(got, Bytes(got.size(), static_cast<std::byte>(*from * 16 + world.rank())));
  }
  for (int from = 0; from < world.size(); ++from) {
    if (!talk.incoming[static_cast<std::size_t>(from)].empty()) expected.insert(from);
  }
  EXPECT_EQ(told, expected);
  transfer.wait();
}

TEST(Transfer, TwoAtATimeDoNotMix) {
  Communicator world(MPI_COMM_WORLD);
  Talk one(world);
  Talk two(world);
  for (Bytes& each : two.outgoing) std::fill(each.begin(), each.end(), std::byte{99});
  Transfer first(world, 2);
  Transfer second(world, 3);
  if (world.rank() % 2 == 0) {
    one.post(first);
    two.post(second);
  } else {
    two.post(second);
    one.post(first);
  }
  second.wait();
  first.wait();
  one.expect_here(world);
  for (const Bytes& each : two.incoming) EXPECT_EQ(each, Bytes(each.size(), std::byte{99}));
}

TEST(Transfer, WaitsWhenItIsLeftEarly) {
  Communicator world(MPI_COMM_WORLD);
  Talk talk(world);
  {
    Transfer transfer(world, 2);
    talk.post(transfer);
  }
  talk.expect_here(world);
}

TEST(Transfer, RefusesAMessageOfAnotherSize) {
  Communicator world(MPI_COMM_WORLD);
  if (world.size() == 1) return;
  const int next = (world.rank() + 1) % world.size();
  const int before = (world.rank() + world.size() - 1) % world.size();
  const Bytes out(10);
  Bytes in(11);
  Transfer transfer(world, 2);
  transfer.receive(before, in);
  transfer.send(next, out);
  EXPECT_THROW(transfer.wait(), Error);
}

TEST(Transfer, SizesReachEveryRank) {
  Communicator world(MPI_COMM_WORLD);
  std::vector<std::uint64_t> mine;
  for (int to = 0; to < world.size(); ++to) mine.push_back(length(world.rank(), to));
  const std::vector<std::uint64_t> theirs = exchange_sizes(world, mine);
  for (int from = 0; from < world.size(); ++from) {
    EXPECT_EQ(theirs[static_cast<std::size_t>(from)], length(from, world.rank()));
  }
  EXPECT_EQ(world.traffic().bytes, 8 * (world.size() - 1));
  EXPECT_EQ(world.traffic().messages, world.size() - 1);
}

}  // namespace
}  // namespace footwall::comm
