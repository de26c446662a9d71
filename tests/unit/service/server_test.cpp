#include "engine/service/server/server.h"

#include <sys/stat.h>

#include "engine_at_work.h"

namespace footwall::service {
namespace {

// Answers every command with as little as its reply needs, and notes what came.
struct Answers {
  std::mutex mutex;
  std::vector<v1::Command> commands;

  StandInRanks::Work work() {
    return [this](const v1::Command& command, Call& call) {
      {
        const std::scoped_lock lock(mutex);
        commands.push_back(command);
      }
      answer(command, call);
    };
  }
  static void answer(const v1::Command& command, Call& call) {
    switch (command.what_case()) {
      case v1::Command::kOpenVolume: {
        call.context().report(0.5, "read", "1 of 2 GiB");
        v1::OpenVolumeReply reply;
        reply.mutable_opened()->set_volume(command.open_volume().volume().checksum());
        return call.send(reply);
      }
      case v1::Command::kCloseVolume:
        return call.send(v1::CloseVolumeReply());
      case v1::Command::kEditModel: {
        v1::EditModelReply reply;
        reply.set_edit(command.edit_model().edit());
        return call.send(reply);
      }
      case v1::Command::kReadModel:
        return call.send(v1::ReadModelReply());
      case v1::Command::kExtract: {
        v1::ExtractReply reply;
        reply.mutable_done()->set_faces(7);
        return call.send(reply);
      }
      case v1::Command::kFaceVoxels:
        return call.send(v1::FaceVoxelsReply());
      case v1::Command::kReadBox: {
        v1::ReadBoxReply reply;
        reply.set_values(command.read_box().volume());
        return call.send(reply);
      }
      case v1::Command::kIsosurface: {
        v1::IsosurfaceReply reply;
        reply.mutable_done();
        return call.send(reply);
      }
      case v1::Command::kRender: {
        v1::RenderReply reply;
        reply.mutable_done();
        return call.send(reply);
      }
      default:
        throw Error(ErrorCode::kUnsupported, "no such command in this test");
    }
  }
};

template <class Reply>
struct Streamed {
  std::vector<Reply> replies;
  grpc::Status status;
};
template <class Reply>
Streamed<Reply> all_of(std::unique_ptr<grpc::ClientReader<Reply>> reader) {
  Streamed<Reply> streamed;
  Reply reply;
  while (reader->Read(&reply)) streamed.replies.push_back(reply);
  streamed.status = reader->Finish();
  return streamed;
}

TEST(Server, TellsItsStatus) {
  EngineAtWork engine;
  engine.status.threads = 3;
  engine.status.ranks = {{"north", 12, 100, 0.25}, {"south\xff", 13, 200}};
  engine.status.volumes = {{"00112233445566ff", "/data/a.fwv", {4, 5, 6}, 480}};
  engine.status.faces = 9;
  engine.status.edit = 8;
  engine.status.state_hash = 255;
  Context context;
  v1::StatusReply reply;
  ASSERT_TRUE(engine.stub->Status(&context, {}, &reply).ok());
  EXPECT_EQ(reply.version(), "1.2.3");
  EXPECT_EQ(reply.host(), "north");
  EXPECT_EQ(reply.process(), 12);
  EXPECT_EQ(reply.ranks(), 2);
  EXPECT_EQ(reply.each_rank(1).host(), "south?");
  EXPECT_EQ(reply.each_rank(0).start_seconds(), 0.25);
  EXPECT_FALSE(reply.each_rank(1).has_start_seconds());
  EXPECT_EQ(reply.volumes(0).dims().k(), 6);
  EXPECT_EQ(reply.state_hash(), "00000000000000ff");
  EXPECT_EQ(reply.jobs_size(), 0);
}

TEST(Server, CommandsGoToTheRanksAndTheirAnswersBack) {
  Answers answers;
  EngineAtWork engine(answers.work());
  {
    Context context;
    v1::OpenVolumeRequest request;
    request.mutable_volume()->set_checksum("abc");
    const auto opened = all_of(engine.stub->OpenVolume(&context, request));
    ASSERT_TRUE(opened.status.ok()) << opened.status.error_message();
    ASSERT_EQ(opened.replies.size(), 2U);
    EXPECT_EQ(opened.replies[0].progress().phase(), "read");
    EXPECT_EQ(opened.replies[0].progress().amounts(), "1 of 2 GiB");
    EXPECT_EQ(opened.replies[1].opened().volume(), "abc");
  }
  {
    Context context;
    v1::EditBatch batch;
    batch.set_edit(41);
    batch.add_edits()->set_clear(true);
    v1::EditModelReply reply;
    ASSERT_TRUE(engine.stub->EditModel(&context, batch, &reply).ok());
    EXPECT_EQ(reply.edit(), 41U);
  }
  {
    Context context;
    v1::CloseVolumeReply reply;
    EXPECT_TRUE(engine.stub->CloseVolume(&context, {}, &reply).ok());
  }
  const auto ends_well = [&](auto method, const auto& request) {
    Context context;
    const auto streamed = all_of((engine.stub.get()->*method)(&context, request));
    EXPECT_TRUE(streamed.status.ok()) << streamed.status.error_message();
    return streamed.replies.size() == 1;
  };
  EXPECT_TRUE(ends_well(&v1::Engine::Stub::ReadModel, v1::ReadModelRequest()));
  EXPECT_TRUE(ends_well(&v1::Engine::Stub::Extract, v1::ExtractRequest()));
  EXPECT_TRUE(ends_well(&v1::Engine::Stub::FaceVoxels, v1::FaceVoxelsRequest()));
  EXPECT_TRUE(ends_well(&v1::Engine::Stub::ReadBox, v1::ReadBoxRequest()));
  EXPECT_TRUE(ends_well(&v1::Engine::Stub::Isosurface, v1::IsosurfaceRequest()));
  EXPECT_TRUE(ends_well(&v1::Engine::Stub::Render, v1::RenderRequest()));
  const std::scoped_lock lock(answers.mutex);
  ASSERT_EQ(answers.commands.size(), 9U);
  EXPECT_EQ(answers.commands[0].open_volume().volume().checksum(), "abc");
  EXPECT_TRUE(answers.commands[1].edit_model().edits(0).clear());
  for (std::size_t n = 0; n < answers.commands.size(); ++n) EXPECT_EQ(answers.commands[n].job(), n + 1);
}

TEST(Server, AFailureComesWithItsCodeMessageAndHint) {
  EngineAtWork engine([](const v1::Command&, Call&) {
    throw Error(ErrorCode::kNotFound, "volume \xff is not here", "open it");
  });
  Context context;
  v1::CloseVolumeReply reply;
  const grpc::Status status = engine.stub->CloseVolume(&context, {}, &reply);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(status.error_message(), "volume ? is not here");
  EXPECT_EQ(context.failure().code(), "not_found");
  EXPECT_EQ(context.failure().message(), "volume ? is not here");
  EXPECT_EQ(context.failure().hint(), "open it");
}

TEST(Server, SuccessWithoutTheOneAnswerIsAnError) {
  EngineAtWork engine([](const v1::Command&, Call&) {});
  Context context;
  v1::CloseVolumeReply reply;
  const grpc::Status status = engine.stub->CloseVolume(&context, {}, &reply);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INTERNAL);
}

TEST(Server, CancelledByItsNumberWhileItRunsOrWaits) {
  Gate gate;
  EngineAtWork engine([&](const v1::Command&, Call& call) { gate.wait(call); });
  Context first_context;
  Context second_context;
  const auto first = engine.stub->Extract(&first_context, {});
  ASSERT_TRUE(eventually([&] { return gate.is_reached(); }));
  const auto second = engine.stub->Extract(&second_context, {});
  v1::StatusReply status;
  ASSERT_TRUE(eventually([&] {
    Context context;
    return engine.stub->Status(&context, {}, &status).ok() && status.jobs_size() == 2;
  }));
  EXPECT_TRUE(status.jobs(0).running());
  EXPECT_EQ(status.jobs(0).what(), "Extract");
  EXPECT_FALSE(status.jobs(1).running());
  const auto cancel = [&](std::uint64_t job) {
    Context context;
    v1::CancelRequest request;
    request.set_job(job);
    v1::CancelReply reply;
    EXPECT_TRUE(engine.stub->Cancel(&context, request, &reply).ok());
    return reply.found();
  };
  EXPECT_FALSE(cancel(99));
  // The one that waits ends at once, though the other runs on.
  EXPECT_TRUE(cancel(status.jobs(1).job()));
  EXPECT_EQ(second->Finish().error_code(), grpc::StatusCode::CANCELLED);
  EXPECT_TRUE(gate.is_reached());
  EXPECT_TRUE(cancel(status.jobs(0).job()));
  EXPECT_EQ(first->Finish().error_code(), grpc::StatusCode::CANCELLED);
  EXPECT_EQ(first_context.failure().code(), "cancelled");
}

TEST(Server, LeavingCancels) {
  Gate gate;
  EngineAtWork engine([&](const v1::Command&, Call& call) { gate.wait(call); });
  Context running;
  Context waiting;
  const auto first = engine.stub->Extract(&running, {});
  ASSERT_TRUE(eventually([&] { return gate.is_reached(); }));
  const auto second = engine.stub->Extract(&waiting, {});
  ASSERT_TRUE(eventually([&] { return engine.queue.entries().size() == 2; }));
  waiting.TryCancel();
  EXPECT_TRUE(eventually([&] { return engine.queue.entries().size() == 1; }));
  running.TryCancel();
  EXPECT_TRUE(eventually([&] { return engine.queue.entries().empty(); }));
  EXPECT_EQ(engine.ranks.served(), 1);
}

TEST(Server, ADeadlineCancels) {
  Gate gate;
  EngineAtWork engine([&](const v1::Command&, Call& call) { gate.wait(call); });
  Context context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::milliseconds(100));
  const auto reader = engine.stub->Extract(&context, {});
  EXPECT_EQ(reader->Finish().error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  EXPECT_TRUE(eventually([&] { return engine.queue.entries().empty(); }));
}

TEST(Server, AFullQueueRefuses) {
  Gate gate;
  EngineAtWork engine([&](const v1::Command&, Call& call) { gate.wait(call); }, {}, 1);
  Context running;
  Context waiting;
  const auto first = engine.stub->Extract(&running, {});
  ASSERT_TRUE(eventually([&] { return gate.is_reached(); }));
  const auto second = engine.stub->Extract(&waiting, {});
  ASSERT_TRUE(eventually([&] { return engine.queue.entries().size() == 2; }));
  Context refused;
  EXPECT_EQ(engine.stub->Extract(&refused, {})->Finish().error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_EQ(refused.failure().code(), "memory");
  gate.open();
  EXPECT_TRUE(first->Finish().ok());
  EXPECT_TRUE(second->Finish().ok());
}

TEST(Server, ShutdownIsToldOnceAndAnswered) {
  EngineAtWork engine;
  for (int n = 0; n < 2; ++n) {
    Context context;
    v1::ShutdownReply reply;
    EXPECT_TRUE(engine.stub->Shutdown(&context, {}, &reply).ok());
  }
  EXPECT_TRUE(eventually([&] { return engine.shutdowns == 1; }));
}

TEST(Server, ItsEndEndsCallsUnderWay) {
  Gate gate;
  EngineAtWork engine([&](const v1::Command&, Call& call) { gate.wait(call); });
  Context running;
  Context waiting;
  Context idle;
  const auto first = engine.stub->Extract(&running, {});
  ASSERT_TRUE(eventually([&] { return gate.is_reached(); }));
  const auto second = engine.stub->Extract(&waiting, {});
  const auto live = engine.stub->Live(&idle);
  ASSERT_TRUE(eventually([&] { return engine.queue.entries().size() == 2; }));
  const std::string socket = engine.server->address().substr(5);
  engine.server.reset();
  EXPECT_EQ(first->Finish().error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_EQ(running.failure().code(), "engine");
  EXPECT_EQ(second->Finish().error_code(), grpc::StatusCode::UNAVAILABLE);
  // One that had not come that far is left by gRPC itself; clients take it for the engine's end, too.
  const auto left = live->Finish().error_code();
  EXPECT_TRUE(left == grpc::StatusCode::UNAVAILABLE || left == grpc::StatusCode::CANCELLED) << left;
  EXPECT_FALSE(std::filesystem::exists(socket));
}

TEST(Server, ManyClientsAtOnce) {
  Answers answers;
  EngineAtWork engine(answers.work());
  std::vector<std::thread> clients;
  std::atomic<int> good{0};
  for (int client = 0; client < 16; ++client) {
    clients.emplace_back([&, client] {
      const auto stub = v1::Engine::NewStub(engine.channel());
      for (int n = 0; n < 20; ++n) {
        Context context;
        v1::ReadBoxRequest request;
        request.set_volume(fmt::format("{} {}", client, n));
        const auto box = all_of(stub->ReadBox(&context, request));
        if (box.status.ok() && box.replies.size() == 1 && box.replies[0].values() == request.volume()) ++good;
      }
    });
  }
  for (std::thread& client : clients) client.join();
  EXPECT_EQ(good, 320);
}

TEST(Server, LargeAnswersComeWhole) {
  EngineAtWork engine([](const v1::Command&, Call& call) {
    for (int n = 0; n < 40; ++n) {
      v1::ReadBoxReply reply;
      reply.set_values(std::string(std::size_t{1} << 20, static_cast<char>('a' + n % 26)));
      call.send(reply);
    }
  });
  Context context;
  const auto box = all_of(engine.stub->ReadBox(&context, {}));
  ASSERT_TRUE(box.status.ok()) << box.status.error_message();
  ASSERT_EQ(box.replies.size(), 40U);
  for (std::size_t n = 0; n < 40; ++n)
    EXPECT_EQ(box.replies[n].values(), std::string(std::size_t{1} << 20, static_cast<char>('a' + n % 26)));
}

TEST(Server, TheSocketIsItsUsersAlone) {
  EngineAtWork engine;
  struct stat facts = {};
  ASSERT_EQ(::lstat(engine.server->address().substr(5).c_str(), &facts), 0);
  EXPECT_TRUE(S_ISSOCK(facts.st_mode));
  EXPECT_EQ(facts.st_mode & 0777U, 0600U);
}

}  // namespace
}  // namespace footwall::service
