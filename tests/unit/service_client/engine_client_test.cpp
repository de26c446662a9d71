#include "engine/service/client/engine_client.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <thread>

#include "scratch_folder.h"
#include "storage/base/error.h"
#include "unit/service_client/fake_engine.h"

namespace footwall::service {
namespace {

Error error_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& error) {
    return error;
  }
  return Error(ErrorCode::kInternal, "nothing was thrown");
}

class Client : public testing::Test {
 protected:
  Client() : engine("right") {
    connection.address = "unix:" + (folder / "s").string();
    connection.token = "right";
    grpc::ServerBuilder builder;
    builder.AddListeningPort(connection.address, grpc::InsecureServerCredentials());
    builder.RegisterService(&engine);
    server = builder.BuildAndStart();
  }
  ~Client() override { server->Shutdown(std::chrono::system_clock::now()); }

  static v1::ExtractRequest of_volume(const std::string& volume) {
    v1::ExtractRequest request;
    request.set_volume(volume);
    return request;
  }

  ScratchFolder folder;
  Connection connection;
  FakeEngine engine;
  std::unique_ptr<grpc::Server> server;
};

TEST_F(Client, AnswersArriveWithTheirProgress) {
  EngineClient client(connection);
  EXPECT_EQ(client.status().version(), "fake");
  v1::EditBatch batch;
  batch.set_edit(41);
  EXPECT_EQ(client.edit(batch).edit(), 41);
  std::vector<std::string> phases;
  const JobContext job([&](const Progress& progress) { phases.emplace_back(progress.phase); });
  int pieces = 0;
  const v1::ExtractDone done = client.extract(
      of_volume("v"), [&](const v1::FaceNumbers& numbers) { pieces += numbers.count(0) == 7; }, job);
  EXPECT_EQ(done.faces(), 2);
  EXPECT_EQ(pieces, 2);
  EXPECT_EQ(phases, std::vector<std::string>{"voxelize"});
}

TEST_F(Client, TheEnginesErrorArrivesAsItWas) {
  EngineClient client(connection);
  const Error error = error_of([&] { client.extract(of_volume("bad"), {}, {}); });
  EXPECT_EQ(error.code(), ErrorCode::kMemory);
  EXPECT_EQ(error.message(), "needs 4.3 GiB");
  EXPECT_EQ(error.hint(), "give more ranks");
  const Error missing = error_of([&] { client.close_volume("v"); });
  EXPECT_EQ(missing.code(), ErrorCode::kUnsupported);
  EXPECT_EQ(client.status().version(), "fake");  // and goes on
}

TEST_F(Client, AWrongTokenIsToldAsSuch) {
  connection.token = "wrong";
  EXPECT_EQ(error_of([&] { EngineClient client(connection); }).code(), ErrorCode::kInvalid);
}

TEST_F(Client, WhereNobodyListensIsToldAsSuch) {
  connection.address = "unix:" + (folder / "nobody").string();
  const Error error = error_of([&] { EngineClient client(connection); });
  EXPECT_EQ(error.code(), ErrorCode::kEngine);
  EXPECT_NE(error.message().find("nobody answers"), std::string::npos);
  connection.address = "tcp:127.0.0.1:1";
  connection.certificate = "none";
  EXPECT_EQ(error_of([&] { EngineClient client(connection); }).code(), ErrorCode::kEngine);
}

TEST_F(Client, CancelLeavesTheCall) {
  EngineClient client(connection);
  for (const char* volume : {"waiting", "endless"}) {
    JobContext* running = nullptr;
    JobContext job([&](const Progress&) { running->cancel(); });
    running = &job;
    EXPECT_EQ(error_of([&] { client.extract(of_volume(volume), {}, job); }).code(), ErrorCode::kCancelled);
  }
  // From another thread, while nothing arrives.
  const JobContext job;
  std::thread canceller([&] {
    while (engine.left == 0) std::this_thread::yield();
    job.cancel();
  });
  EXPECT_EQ(error_of([&] { client.extract(of_volume("waiting"), {}, job); }).code(), ErrorCode::kCancelled);
  canceller.join();
  EXPECT_EQ(client.status().version(), "fake");
}

TEST_F(Client, AnExceptionOfTheListenerEndsTheCall) {
  EngineClient client(connection);
  const Error error = error_of([&] {
    client.extract(of_volume("endless"),
                   [](const v1::FaceNumbers&) { throw Error(ErrorCode::kIo, "disk full"); }, {});
  });
  EXPECT_EQ(error.code(), ErrorCode::kIo);
  EXPECT_EQ(client.status().version(), "fake");
}

TEST_F(Client, BoxesAreWholeOrRefused) {
  EngineClient client(connection);
  v1::ReadBoxRequest request;
  request.mutable_box()->mutable_hi()->set_i(3);
  request.mutable_box()->mutable_hi()->set_j(5);
  request.mutable_box()->mutable_hi()->set_k(7);
  request.mutable_box()->mutable_lo();
  for (const bool compress : {false, true}) {
    request.set_compress(compress);
    request.set_volume("v");
    const std::vector<float> values = client.read_box(request, {});
    ASSERT_EQ(values.size(), 105U);
    for (std::size_t n = 0; n < values.size(); ++n) EXPECT_EQ(values[n], static_cast<float>(n));
    for (const char* wrong : {"short", "bomb"}) {
      request.set_volume(wrong);
      EXPECT_EQ(error_of([&] { client.read_box(request, {}); }).code(), ErrorCode::kEngine);
    }
  }
  request.mutable_box()->mutable_hi()->set_i(-3);
  EXPECT_EQ(error_of([&] { client.read_box(request, {}); }).code(), ErrorCode::kInvalid);
}

TEST_F(Client, LiveEditsAreAnsweredOnTheirThread) {
  EngineClient client(connection);
  std::mutex mutex;
  std::vector<std::uint64_t> edits;
  const auto live = client.live("v", {}, [&](const v1::LiveReply& reply) {
    const std::scoped_lock lock(mutex);
    edits.push_back(reply.edit());
  });
  v1::EditBatch batch;
  batch.add_edits()->set_clear(true);
  for (std::uint64_t n = 1; n <= 100; ++n) {
    batch.set_edit(n);
    live->send(batch);
  }
  live->finish();
  ASSERT_EQ(edits.size(), 100U);
  EXPECT_EQ(edits.back(), 100U);
}

TEST_F(Client, ALiveStreamTellsWhyItEnded) {
  EngineClient client(connection);
  const auto live = client.live("v", {}, [](const v1::LiveReply&) {});
  const v1::EditBatch nothing;
  EXPECT_EQ(error_of([&] {
              for (int n = 0; n < 100000; ++n) live->send(nothing);
              live->finish();
            }).code(),
            ErrorCode::kMemory);
  // One that nobody finishes ends with its object.
  client.live("v", {}, [](const v1::LiveReply&) {})->send(nothing);
}

TEST_F(Client, FilesOfATaskTravelWhole) {
  EngineClient client(connection);
  std::string large(3'500'000, '\0');
  for (std::size_t n = 0; n < large.size(); ++n) large[n] = static_cast<char>(n * 7 + n / 1000);
  const std::vector<EngineClient::InputFile> in{{"large", folder.file("large", large)},
                                                {"empty", folder.file("empty", "")}};
  v1::Task task;
  task.set_kind("batch");
  std::map<std::string, std::string> out;
  const auto take = [&](const v1::FilePiece& piece) { out[piece.name()] += piece.bytes(); };
  EXPECT_EQ(client.run_task(task, in, take, {}), R"({"kind": "batch"})");
  EXPECT_EQ(out.at("large"), large);
  EXPECT_EQ(out.at("empty"), "");
  EXPECT_EQ(out.at("result.json"), R"({"kind": "batch"})");
  // Refused while files are still on their way.
  task.set_kind("refused");
  EXPECT_EQ(error_of([&] { client.run_task(task, in, take, {}); }).code(), ErrorCode::kMemory);
  task.set_kind("batch");
  const std::vector<EngineClient::InputFile> missing{{"x", (folder / "missing").string()}};
  EXPECT_EQ(error_of([&] { client.run_task(task, missing, take, {}); }).code(), ErrorCode::kNotFound);
}

TEST_F(Client, AServersEndIsTheEnginesEnd) {
  EngineClient client(connection);
  std::thread ender([&] {
    while (engine.left == 0) std::this_thread::yield();
    server->Shutdown(std::chrono::system_clock::now());
  });
  JobContext* running = nullptr;
  JobContext job([&](const Progress&) { running->cancel(); });
  running = &job;
  EXPECT_EQ(error_of([&] { client.extract(of_volume("waiting"), {}, job); }).code(), ErrorCode::kCancelled);
  ender.join();
  EXPECT_EQ(error_of([&] { client.status(); }).code(), ErrorCode::kEngine);
}

}  // namespace
}  // namespace footwall::service
