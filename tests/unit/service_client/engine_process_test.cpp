#include "engine/service/client/engine_process.h"

#include <set>
#include <thread>

#include "engine/service/client/engine_client.h"
#include "storage/base/error.h"
#include "unit/service_client/fake_process.h"

namespace footwall::service {
namespace {

class Process : public FakeProcess {
 protected:
  static Error error_of_start(const std::string& how) {
    setenv("FAKE_ENGINE_HOW", how.c_str(), 1);
    EngineProcess process(options());
    try {
      process.wait_until_ready({});
    } catch (const Error& error) {
      return error;
    }
    return Error(ErrorCode::kInternal, "nothing was thrown");
  }
};

TEST_F(Process, ServesUntilItIsStoppedAndLeavesNothing) {
  int number = 0;
  {
    EngineProcess process(options());
    const Connection connection = process.wait_until_ready({});
    EXPECT_EQ(connection.token.size(), 64U);
    number = connection.process;
    EngineClient client(connection);
    EXPECT_EQ(client.status().process(), number);
    EXPECT_FALSE(process.wait_for_end(std::chrono::milliseconds(0)));
    EXPECT_EQ(folders(), 1);
    process.stop();
    EXPECT_TRUE(process.ended_well());
  }
  EXPECT_TRUE(is_gone(number));
  EXPECT_EQ(folders(), 0);
}

TEST_F(Process, AClientsStopIsAGoodEnd) {
  EngineProcess process(options());
  EngineClient(process.wait_until_ready({})).shutdown();
  EXPECT_TRUE(process.wait_for_end(std::chrono::minutes(1)));
  EXPECT_TRUE(process.ended_well());
}

TEST_F(Process, OneThatIsKilledDidNotEndWell) {
  EngineProcess process(options());
  kill(process.wait_until_ready({}).process, SIGKILL);
  EXPECT_TRUE(process.wait_for_end(std::chrono::minutes(1)));
  EXPECT_FALSE(process.ended_well());
  EXPECT_NE(process.last_words().find("signal 9"), std::string::npos) << process.last_words();
  EXPECT_NE(process.last_words().find("words of mpirun"), std::string::npos);
}

TEST_F(Process, SaysWhyItCannotServe) {
  const Error own = error_of_start("error");
  EXPECT_EQ(own.code(), ErrorCode::kIo);
  EXPECT_EQ(own.message(), "cannot listen");
  const Error words = error_of_start("words");
  EXPECT_EQ(words.code(), ErrorCode::kEngine);
  EXPECT_NE(words.hint().find("there is no library"), std::string::npos);
  setenv("FOOTWALL_LAUNCHER", "/there/is/no/launcher", 1);
  EXPECT_EQ(error_of_start("").code(), ErrorCode::kEngine);
  EngineProcessOptions long_path = options();
  long_path.listen = "unix:/" + std::string(120, 'x');
  EXPECT_THROW(EngineProcess process(long_path), Error);
  EXPECT_EQ(folders(), 0);
}

TEST_F(Process, WaitingIsCancelled) {
  setenv("FAKE_ENGINE_HOW", "never", 1);
  EngineProcess process(options());
  const JobContext job;
  std::thread canceller([&] { job.cancel(); });
  try {
    process.wait_until_ready(job);
    FAIL() << "it is never ready";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kCancelled);
  }
  canceller.join();
}

TEST_F(Process, ADeathInTheMiddleOfAStreamIsNoticed) {
  EngineProcess process(options());
  const Connection connection = process.wait_until_ready({});
  EngineClient client(connection);
  v1::ExtractRequest request;
  for (const char* volume : {"waiting", "endless"}) {
    if (is_gone(connection.process)) break;
    request.set_volume(volume);
    const JobContext job([&](const Progress&) { kill(connection.process, SIGKILL); });
    try {
      client.extract(request, {}, job);
      FAIL() << "nothing was thrown";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kEngine);
      EXPECT_FALSE(error.hint().empty());
    }
  }
}

TEST_F(Process, OneThatDoesNotAnswerIsToldAsSuch) {
  EngineProcess process(options());
  const Connection connection = process.wait_until_ready({});
  kill(connection.process, SIGSTOP);
  try {
    EngineClient client(connection);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kEngine);
  }
  kill(connection.process, SIGCONT);
}

// Well before the system would tell: it is asked for every now and then.
TEST_F(Process, AHangInTheMiddleOfACallIsNoticedAndAPauseIsNone) {
  EngineProcess process(options());
  const Connection connection = process.wait_until_ready({});
  EngineClient client(connection);
  v1::ExtractRequest request;
  request.set_volume("waiting");
  std::thread pause;
  const JobContext job([&](const Progress&) {
    kill(connection.process, SIGSTOP);
    pause = std::thread([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(600));  // the pause that is tested
      kill(connection.process, SIGCONT);
      EngineClient(connection).status();
      kill(connection.process, SIGSTOP);
    });
  });
  const auto begun = std::chrono::steady_clock::now();
  try {
    client.extract(request, {}, job);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kEngine);
    EXPECT_NE(error.message().find("does not answer"), std::string::npos) << error.message();
  }
  pause.join();
  const auto took = std::chrono::steady_clock::now() - begun;
  EXPECT_GT(took, std::chrono::milliseconds(600));
  EXPECT_LT(took, std::chrono::seconds(20));
  fmt::print("noticed after {} ms\n",
             std::chrono::duration_cast<std::chrono::milliseconds>(took).count() - 600);
  process.kill();
}

TEST(RandomToken, IsNeverTheSame) {
  std::set<std::string> tokens;
  for (int n = 0; n < 100; ++n) tokens.insert(random_token());
  EXPECT_EQ(tokens.size(), 100U);
  EXPECT_EQ(tokens.begin()->find_first_not_of("0123456789abcdef"), std::string::npos);
}

}  // namespace
}  // namespace footwall::service
