#include "engine/service/client/local_engine.h"

#include <atomic>
#include <thread>

#include "storage/base/error.h"
#include "unit/service_client/fake_process.h"

namespace footwall::service {
namespace {

using Local = FakeProcess;

// What a program has: ten edits, of which the engine knows those that were replayed.
void replay(EngineClient& client) {
  v1::EditBatch batch;
  batch.set_edit(10);
  client.edit(batch);
}

TEST_F(Local, StartsWhenFirstNeededAndEndsWithItsObject) {
  int process = 0;
  {
    LocalEngine engine(launch(), replay);
    EXPECT_FALSE(engine.is_running());
    EXPECT_EQ(engine.starts(), 0);
    EXPECT_EQ(engine.client()->status().edit(), 10U);
    process = engine.client()->status().process();
    EXPECT_TRUE(engine.is_running());
    EXPECT_EQ(engine.starts(), 1);
  }
  EXPECT_TRUE(is_gone(process));
  EXPECT_EQ(folders(), 0);
}

TEST_F(Local, IsStartedAgainAndReplayed) {
  LocalEngine engine(launch(), replay);
  const int first = engine.client()->status().process();
  kill(first, SIGKILL);
  int tries = 0;
  engine.with_engine([&](EngineClient& client) {
    ++tries;
    const v1::StatusReply status = client.status();
    EXPECT_NE(status.process(), first);
    EXPECT_EQ(status.edit(), 10U);
  });
  EXPECT_LE(tries, 2);
  EXPECT_EQ(engine.starts(), 2);
}

TEST_F(Local, ACallThatTheEngineDiesInIsMadeAgain) {
  LocalEngine engine(launch(), replay);
  int tries = 0;
  engine.with_engine([&](EngineClient& client) {
    if (++tries == 1) kill(client.status().process(), SIGKILL);
    EXPECT_EQ(client.status().edit(), 10U);
  });
  EXPECT_EQ(tries, 2);
}

v1::EditBatch put(std::uint64_t edit) {
  v1::EditBatch batch;
  batch.set_edit(edit);
  v1::Faces& faces = *batch.add_edits()->mutable_put();
  faces.add_faults(1);
  faces.add_owners(static_cast<std::int64_t>(edit % 5));
  faces.add_numbers(0);
  faces.mutable_corners()->Resize(9, 0);
  return batch;
}

TEST_F(Local, EditsOutliveTheEngine) {
  LocalEngine engine(launch(), replay);
  EXPECT_EQ(engine.edit(put(0)).edit(), 1U);
  EXPECT_EQ(engine.edit(put(7)).edit(), 7U);
  EXPECT_EQ(engine.edit(put(8)).edit(), 8U);
  const auto faces_of_another = [&] {
    kill(engine.client()->status().process(), SIGKILL);
    std::int64_t faces = -1;
    engine.with_engine([&](EngineClient& client) { faces = client.status().faces(); });
    return faces;
  };
  const std::int64_t faces = engine.client()->status().faces();
  EXPECT_EQ(faces_of_another(), faces);
  engine.forget_edits();
  EXPECT_EQ(faces_of_another(), 0);
}

// The engine is killed, or hangs, in the middle of a stream; every edit is answered, by its own number.
TEST_F(Local, AStreamOfEditsGoesOnInTheNextEngine) {
  for (const int how : {SIGKILL, SIGSTOP}) {
    LocalEngine engine(launch(), replay);
    std::atomic<std::uint64_t> newest{0};
    const auto live = engine.live("v", {}, [&](const v1::LiveReply& reply) {
      EXPECT_GT(reply.edit() + 1, newest);
      newest = reply.edit();
    });
    const int first = engine.client()->status().process();
    for (std::uint64_t n = 1; n <= 300; ++n) {
      live->send(put(n));
      if (n == 150) kill(first, how);
    }
    live->finish();
    EXPECT_EQ(newest, 300U);
    EXPECT_NE(engine.client()->status().process(), first);
    EXPECT_EQ(engine.starts(), 2);
    EXPECT_TRUE(is_gone(first));
  }
}

TEST_F(Local, AStreamEndsByItsOwnError) {
  LocalEngine engine(launch(), replay);
  const auto live = engine.live("v", {}, [](const v1::LiveReply&) {});
  live->send(v1::EditBatch());
  EXPECT_THROW(live->finish(), Error);
  EXPECT_EQ(engine.starts(), 1);
  // One that nobody finishes ends with its object, also when the engine is gone.
  const auto other = engine.live("v", {}, [](const v1::LiveReply&) {});
  other->send(put(5));
  kill(engine.client()->status().process(), SIGKILL);
}

TEST_F(Local, OtherErrorsAreTheCallsOwn) {
  LocalEngine engine(launch(), replay);
  int tries = 0;
  EXPECT_THROW(engine.with_engine([&](EngineClient& client) {
    ++tries;
    client.close_volume("v");
  }),
               Error);
  EXPECT_EQ(tries, 1);
  EXPECT_TRUE(engine.is_running());
  EXPECT_EQ(engine.starts(), 1);
}

TEST_F(Local, GivesUpAfterThreeDeathsInAMinute) {
  LocalEngine engine(launch(), replay);
  for (int n = 0; n < 3; ++n) {
    kill(engine.client()->status().process(), SIGKILL);
    while (engine.is_running()) std::this_thread::yield();
  }
  try {
    engine.client();
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kEngine);
    EXPECT_NE(error.message().find("three times"), std::string::npos);
    EXPECT_NE(error.hint().find("signal 9"), std::string::npos);
  }
  EXPECT_EQ(engine.starts(), 3);
}

TEST_F(Local, OneThatCannotBeStartedSaysWhy) {
  setenv("FAKE_ENGINE_HOW", "words", 1);
  LocalEngine engine(launch(), replay);
  try {
    engine.client();
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kEngine);
    EXPECT_NE(error.hint().find("there is no library"), std::string::npos);
  }
  unsetenv("FAKE_ENGINE_HOW");
  EXPECT_EQ(engine.client()->status().edit(), 10U);
}

TEST_F(Local, AReplayThatFailsIsTold) {
  LocalEngine engine(launch(), [](EngineClient&) { throw Error(ErrorCode::kNotFound, "no volume"); });
  EXPECT_THROW(engine.client(), Error);
  EXPECT_FALSE(engine.is_running());
}

}  // namespace
}  // namespace footwall::service
