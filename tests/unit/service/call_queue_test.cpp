#include "engine/service/queue/call_queue.h"

#include <gtest/gtest.h>

#include <thread>

#include "unit/service/told_call.h"

namespace footwall::service {
namespace {

TEST(CallQueue, GivesCallsInTheirOrderAndReadsFirst) {
  CallQueue queue;
  const auto first = std::make_shared<ToldCall>("First");
  const auto second = std::make_shared<ToldCall>("Second");
  const auto read = std::make_shared<ToldCall>("Read");
  queue.push(first);
  queue.push(second);
  EXPECT_EQ(queue.next_read(), nullptr);
  queue.push_read(read);
  EXPECT_EQ(queue.next(), read);
  queue.done();
  EXPECT_EQ(queue.next(), first);
  EXPECT_TRUE(first->state().running);
  queue.push_read(read);
  EXPECT_EQ(queue.next_read(), read);
  queue.done();
  EXPECT_EQ(queue.next(), second);
  EXPECT_LT(first->id(), second->id());
}

TEST(CallQueue, ListsTheRunningCallFirst) {
  CallQueue queue;
  queue.push(std::make_shared<ToldCall>("First"));
  queue.push(std::make_shared<ToldCall>("Second"));
  const auto running = queue.next();
  const auto entries = queue.entries();
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(entries[0].what, "First");
  EXPECT_TRUE(entries[0].state.running);
  EXPECT_EQ(entries[1].what, "Second");
  EXPECT_FALSE(entries[1].state.running);
  queue.done();
  EXPECT_EQ(queue.entries().size(), 1U);
}

TEST(CallQueue, ACancelledCallThatWaitsIsToldAtOnce) {
  CallQueue queue;
  const auto running = std::make_shared<ToldCall>("Long");
  const auto waiting = std::make_shared<ToldCall>("Waiting");
  queue.push(running);
  queue.push(waiting);
  queue.next();
  EXPECT_TRUE(queue.cancel(waiting->id()));
  EXPECT_EQ(waiting->outcome(), "cancelled");
  EXPECT_FALSE(queue.cancel(waiting->id()));
  // The running one ends by itself, when it looks.
  EXPECT_TRUE(queue.cancel(running->id()));
  EXPECT_TRUE(running->context().cancelled());
  EXPECT_EQ(running->outcome(), "under way");
  EXPECT_FALSE(queue.cancel(99));
}

TEST(CallQueue, RefusesMoreThanItsMostButTakesThePlacesOfThoseWhoLeft) {
  CallQueue queue(2);
  const auto left = std::make_shared<ToldCall>("Left");
  queue.push(left);
  queue.push(std::make_shared<ToldCall>("Stays"));
  try {
    queue.push(std::make_shared<ToldCall>("Refused"));
    FAIL() << "a third one was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kMemory);
  }
  left->context().cancel();
  queue.push(std::make_shared<ToldCall>("Third"));
  EXPECT_EQ(left->outcome(), "cancelled");
  EXPECT_EQ(queue.next()->what(), "Stays");
  EXPECT_EQ(queue.next()->what(), "Third");
}

TEST(CallQueue, CloseFailsThoseThatWaitAndCancelsTheRunningOne) {
  CallQueue queue;
  const auto running = std::make_shared<ToldCall>("Running");
  const auto waiting = std::make_shared<ToldCall>("Waiting");
  queue.push(running);
  queue.push(waiting);
  queue.next();
  queue.close(Error(ErrorCode::kEngine, "the engine ends"));
  EXPECT_EQ(waiting->outcome(), "engine");
  EXPECT_TRUE(running->context().cancelled());
  EXPECT_EQ(queue.next(), nullptr);
  EXPECT_THROW(queue.push(std::make_shared<ToldCall>("Late")), Error);
}

TEST(CallQueue, ACallMayBePushedAgainAndKeepsItsNumber) {
  CallQueue queue;
  const auto call = std::make_shared<ToldCall>("Live");
  queue.push(call);
  const std::uint64_t id = call->id();
  queue.next();
  queue.done();
  queue.push(call);
  EXPECT_EQ(call->id(), id);
  EXPECT_EQ(queue.next(), call);
}

TEST(CallQueue, WakesADispatcherForEveryCallOfManyThreads) {
  CallQueue queue(10000);
  constexpr int kThreads = 4;
  constexpr int kEach = 500;
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&] {
      for (int n = 0; n < kEach; ++n) {
        const auto call = std::make_shared<ToldCall>("Call");
        n % 3 == 0 ? queue.push_read(call) : queue.push(call);
      }
    });
  }
  int got = 0;
  for (; got < kThreads * kEach; ++got) {
    ASSERT_NE(queue.next(), nullptr);
    queue.done();
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(queue.entries().size(), 0U);
}

}  // namespace
}  // namespace footwall::service
