#include "engine/tasks/replay_project.h"

#include <gtest/gtest.h>

#include "engine/tasks/edit_script.h"
#include "engine/tasks/volume_sources.h"
#include "scratch_folder.h"
#include "storage/base/error.h"
#include "unit/service_client/fake_engine.h"

namespace footwall::tasks {
namespace {

class Replay : public testing::Test {
 protected:
  Replay() : engine("token") {
    connection.address = "unix:" + (folder / "s").string();
    connection.token = "token";
    grpc::ServerBuilder builder;
    builder.AddListeningPort(connection.address, grpc::InsecureServerCredentials());
    builder.RegisterService(&engine);
    server = builder.BuildAndStart();
  }
  ~Replay() override { server->Shutdown(std::chrono::system_clock::now()); }

  static project::VolumeRecord volume(const std::string& name, const std::string& checksum) {
    project::VolumeRecord record;
    record.name = name;
    record.file = name + ".h5";
    record.checksum = checksum;
    record.dims = {20, 20, 20};
    return record;
  }
  static void edit(project::Project& project, const std::string& line) { apply_edit_line(project, line, 1); }

  ScratchFolder folder;
  service::Connection connection;
  service::FakeEngine engine;
  std::unique_ptr<grpc::Server> server;
};

TEST_F(Replay, BringsVolumesAndFaultsAndSaysWhatItCannot) {
  const auto path = folder / "p.footwall";
  {
    project::Project project = project::Project::create(
        path, plain_geometry({20, 20, 20}, survey::Domain::kDepth, survey::VerticalUnit::kMetre, 1));
    project.add_volume(volume("amplitude", "0123456789abcdef"));
    project.add_volume(volume("large", "0000000000000000"));
    project::VolumeRecord aside = volume("aside", "1111111111111111");
    aside.origin = {0, 5, 0};
    aside.dims = {20, 15, 20};
    project.add_volume(aside);
    edit(project, R"({"op":"add","what":"fault","name":"F1"})");
    edit(project, R"({"op":"add","what":"pillar","fault":"F1","nodes":[[2,8,1],[3,9,18]]})");
    edit(project, R"({"op":"add","what":"pillar","fault":"F1","nodes":[[15,8,1],[16,9,18]]})");
    edit(project, R"({"op":"add","what":"fault","name":"F2"})");
  }
  project::Project project = project::Project::open(path, project::OpenMode::kRead);
  service::EngineClient client(connection);
  // What it had before is gone, and edit numbers grow.
  v1::EditBatch before;
  before.set_edit(17);
  before.add_edits()->mutable_put()->mutable_faults()->Resize(99, 1);
  client.edit(before);
  const Replayed done = replay_project(project, client, {});
  // Also one that covers a part of the survey: the model stands in the survey.
  EXPECT_EQ(done.volumes, (std::vector<std::string>{"amplitude", "aside"}));
  EXPECT_GT(done.faces, 1);
  EXPECT_EQ(client.status().faces(), done.faces);
  EXPECT_EQ(client.status().edit(), 19U);
  ASSERT_EQ(done.notices.size(), 2U);
  EXPECT_NE(done.notices[0].find("volume large is left out: needs 4.3 GiB"), std::string::npos);
  EXPECT_NE(done.notices[1].find("F2"), std::string::npos);
  // The same again is the same.
  EXPECT_EQ(replay_project(project, client, {}).faces, done.faces);
}

TEST_F(Replay, AnEngineThatIsGoneIsTold) {
  project::Project project = project::Project::create(
      folder / "p.footwall",
      plain_geometry({20, 20, 20}, survey::Domain::kDepth, survey::VerticalUnit::kMetre, 1));
  project.add_volume(volume("amplitude", "0123456789abcdef"));
  service::EngineClient client(connection);
  server->Shutdown(std::chrono::system_clock::now());
  try {
    replay_project(project, client, {});
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kEngine);
  }
}

}  // namespace
}  // namespace footwall::tasks
