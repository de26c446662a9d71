// The calls that are more than one message and its answers: Live, RunTask, Interpolate, Triangulate.
#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "engine_at_work.h"
#include "storage/survey/geometry_json.h"

namespace footwall::service {
namespace {

v1::LiveRequest edit(std::uint64_t number) {
  v1::LiveRequest request;
  request.mutable_batch()->set_edit(number);
  return request;
}

// Notes the batches of each step, and answers under the newest one's number.
struct LiveSteps {
  std::mutex mutex;
  std::vector<std::vector<std::uint64_t>> steps;
  Gate gate;

  void answer(const v1::Command& command, Call& call) {
    const v1::LiveStep& step = command.live();
    std::vector<std::uint64_t> numbers;
    for (const v1::EditBatch& batch : step.batches()) numbers.push_back(batch.edit());
    {
      const std::scoped_lock lock(mutex);
      steps.push_back(numbers);
    }
    EXPECT_EQ(step.volume(), "abc");
    EXPECT_GE(step.waited_seconds(), 0);
    gate.wait(call);
    v1::LiveReply reply;
    reply.set_edit(numbers.back());
    call.send(reply);
  }
};

TEST(Live, EditsThatComeMeanwhileAreOneStepUnderTheNewestNumber) {
  LiveSteps steps;
  EngineAtWork engine([&](const v1::Command& command, Call& call) { steps.answer(command, call); });
  Context context;
  const auto live = engine.stub->Live(&context);
  v1::LiveRequest first = edit(1);
  first.set_volume("abc");
  ASSERT_TRUE(live->Write(first));
  ASSERT_TRUE(eventually([&] { return steps.gate.is_reached(); }));
  constexpr std::uint64_t kLast = 50;
  for (std::uint64_t n = 2; n <= kLast; ++n) ASSERT_TRUE(live->Write(edit(n)));
  ASSERT_TRUE(live->WritesDone());
  steps.gate.open();
  std::vector<std::uint64_t> answered;
  v1::LiveReply reply;
  while (live->Read(&reply)) answered.push_back(reply.edit());
  EXPECT_TRUE(live->Finish().ok());
  const std::scoped_lock lock(steps.mutex);
  // Every edit is in one step, in order; every step is answered under its newest.
  std::vector<std::uint64_t> all;
  std::vector<std::uint64_t> newest;
  for (const auto& step : steps.steps) {
    all.insert(all.end(), step.begin(), step.end());
    newest.push_back(step.back());
  }
  ASSERT_EQ(all.size(), kLast);
  for (std::uint64_t n = 1; n <= kLast; ++n) EXPECT_EQ(all[n - 1], n);
  EXPECT_EQ(answered, newest);
  EXPECT_EQ(answered.back(), kLast);
  EXPECT_LT(steps.steps.size(), kLast);
  EXPECT_EQ(steps.steps[0].size(), 1U);
}

TEST(Live, GoesOnAfterAPause) {
  LiveSteps steps;
  steps.gate.open();
  EngineAtWork engine([&](const v1::Command& command, Call& call) { steps.answer(command, call); });
  Context context;
  const auto live = engine.stub->Live(&context);
  v1::LiveRequest first;
  first.set_volume("abc");
  ASSERT_TRUE(live->Write(first));
  for (std::uint64_t n = 1; n <= 5; ++n) {
    ASSERT_TRUE(live->Write(edit(n)));
    v1::LiveReply reply;
    ASSERT_TRUE(live->Read(&reply));
    EXPECT_EQ(reply.edit(), n);
  }
  ASSERT_TRUE(live->WritesDone());
  EXPECT_TRUE(live->Finish().ok());
  const std::scoped_lock lock(steps.mutex);
  EXPECT_EQ(steps.steps.size(), 5U);
}

TEST(Live, WhatIsNoLiveStreamIsRefused) {
  EngineAtWork engine([](const v1::Command&, Call&) {});
  const auto status_of = [&](const std::vector<v1::LiveRequest>& requests) {
    Context context;
    const auto live = engine.stub->Live(&context);
    for (const v1::LiveRequest& request : requests) live->Write(request);
    live->WritesDone();
    v1::LiveReply reply;
    while (live->Read(&reply)) {
    }
    return live->Finish().error_code();
  };
  v1::LiveRequest first;
  first.set_volume("abc");
  EXPECT_EQ(status_of({edit(1)}), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(status_of({first, first}), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(status_of({first}), grpc::StatusCode::OK);
}

TEST(Live, AFailureEndsTheStream) {
  EngineAtWork engine(
      [](const v1::Command&, Call&) { throw Error(ErrorCode::kNotFound, "no volume abc", "open it"); });
  Context context;
  const auto live = engine.stub->Live(&context);
  v1::LiveRequest first = edit(1);
  first.set_volume("abc");
  live->Write(first);
  v1::LiveReply reply;
  EXPECT_FALSE(live->Read(&reply));
  EXPECT_EQ(live->Finish().error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(context.failure().hint(), "open it");
}

v1::TaskInput task_of(const std::string& kind) {
  v1::TaskInput input;
  input.mutable_task()->set_kind(kind);
  return input;
}
v1::TaskInput piece_of(const std::string& name, const std::string& bytes, bool last) {
  v1::TaskInput input;
  input.mutable_file()->set_name(name);
  input.mutable_file()->set_bytes(bytes);
  input.mutable_file()->set_last(last);
  return input;
}
v1::TaskInput start() {
  v1::TaskInput input;
  input.set_start(true);
  return input;
}

struct TaskRun {
  std::vector<v1::TaskOutput> outputs;
  grpc::Status status;
  v1::Failure failure;
};
TaskRun run(EngineAtWork& engine, const std::vector<v1::TaskInput>& inputs) {
  TaskRun task;
  Context context;
  const auto stream = engine.stub->RunTask(&context);
  for (const v1::TaskInput& input : inputs) {
    if (!stream->Write(input)) break;
  }
  stream->WritesDone();
  v1::TaskOutput output;
  while (stream->Read(&output)) task.outputs.push_back(output);
  task.status = stream->Finish();
  task.failure = context.failure();
  return task;
}

TEST(RunTask, HasItsFilesAndGivesOthersBack) {
  std::filesystem::path folder;
  EngineAtWork engine([&](const v1::Command& command, Call& call) {
    folder = command.task().folder();
    EXPECT_EQ(command.task().task().kind(), "batch");
    EXPECT_EQ(content_of(folder / "in" / "a.txt"), "first second");
    EXPECT_EQ(content_of(folder / "in" / "B-2_c"), "");
    EXPECT_TRUE(is_directory(folder / "out"));
    struct stat facts = {};
    EXPECT_EQ(::stat((folder / "in" / "a.txt").c_str(), &facts), 0);
    EXPECT_EQ(facts.st_mode & 0777U, 0600U);
    EXPECT_EQ(::stat(folder.c_str(), &facts), 0);
    EXPECT_EQ(facts.st_mode & 0777U, 0700U);
    call.context().report(0.25, "write");
    v1::TaskOutput output;
    output.mutable_file()->set_name("result.json");
    call.send(output);
  });
  const TaskRun task = run(engine, {task_of("batch"), piece_of("a.txt", "first ", false),
                                    piece_of("a.txt", "second", true), piece_of("B-2_c", "", true), start()});
  ASSERT_TRUE(task.status.ok()) << task.status.error_message();
  ASSERT_EQ(task.outputs.size(), 2U);
  EXPECT_EQ(task.outputs[0].progress().fraction(), 0.25);
  EXPECT_EQ(task.outputs[1].file().name(), "result.json");
  EXPECT_TRUE(eventually([&] { return !std::filesystem::exists(folder); }));
}

TEST(RunTask, RefusesWhatIsNoTask) {
  EngineAtWork engine([](const v1::Command&, Call&) { ADD_FAILURE() << "nothing is to be run"; });
  const auto is_refused = [&](const std::vector<v1::TaskInput>& inputs) {
    const TaskRun task = run(engine, inputs);
    return task.status.error_code() == grpc::StatusCode::INVALID_ARGUMENT && task.failure.code() == "invalid";
  };
  for (const std::string& name :
       {std::string(), std::string(".."), std::string("../a"), std::string("/etc/a"), std::string("a/b"),
        std::string(".hidden"), std::string("a\nb"), std::string("a b"), std::string(101, 'a'),
        std::string("a\0b", 3)}) {
    EXPECT_TRUE(is_refused({task_of("batch"), piece_of(name, "x", true), start()})) << name;
  }
  EXPECT_TRUE(is_refused({}));
  EXPECT_TRUE(is_refused({start()}));
  EXPECT_TRUE(is_refused({piece_of("a", "x", true)}));
  EXPECT_TRUE(is_refused({task_of("batch"), task_of("batch")}));
  EXPECT_TRUE(is_refused({task_of("batch"), v1::TaskInput()}));
  EXPECT_TRUE(is_refused({task_of("batch")}));
  EXPECT_TRUE(is_refused({task_of("batch"), piece_of("a", "x", false), start()}));
  EXPECT_TRUE(is_refused({task_of("batch"), piece_of("a", "x", false), piece_of("b", "x", true), start()}));
  EXPECT_TRUE(is_refused({task_of("batch"), piece_of("a", "x", true), piece_of("a", "x", true), start()}));
  EXPECT_TRUE(eventually([&] { return std::filesystem::is_empty(engine.folder / "scratch"); }));
}

survey::Geometry geometry() {
  survey::Geometry geometry;
  geometry.inlines = {100, 1, 60};
  geometry.crosslines = {200, 1, 60};
  geometry.samples = 60;
  geometry.interval = 4;
  geometry.map.per_inline_x = 25;
  geometry.map.per_crossline_y = 25;
  return geometry;
}

void add_pillar(std::int64_t id, double inline_index, google::protobuf::RepeatedPtrField<v1::Pillar>& to) {
  const survey::Geometry survey = geometry();
  v1::Pillar& pillar = *to.Add();
  pillar.set_id(id);
  for (const double k : {10.0, 30.0, 50.0}) {
    const survey::WorldPoint at = survey.world_of(survey::IndexPoint{inline_index, 20 + k / 4, k});
    for (const double value : {at.x, at.y, at.z}) pillar.add_nodes(value);
  }
}

TEST(Pillars, AreInterpolatedAsTheLibraryDoes) {
  EngineAtWork engine;
  v1::InterpolateRequest request;
  request.set_geometry_json(survey::geometry_to_json(geometry()).dump());
  add_pillar(7, 10, *request.mutable_pillars());
  add_pillar(8, 30, *request.mutable_pillars());
  request.set_every(5);
  Context context;
  v1::InterpolateReply reply;
  const grpc::Status status = engine.stub->Interpolate(&context, request, &reply);
  ASSERT_TRUE(status.ok()) << status.error_message();
  ASSERT_EQ(reply.pillars_size(), 3);
  EXPECT_EQ((std::set{reply.pillars(1).first(), reply.pillars(1).second()}), (std::set<std::int64_t>{7, 8}));
  EXPECT_NEAR(reply.pillars(1).parameter(), 0.5, 1e-9);
  ASSERT_EQ(reply.pillars(1).nodes_size(), 9);
  const survey::IndexPoint middle = geometry().index_of(
      survey::WorldPoint{reply.pillars(1).nodes(0), reply.pillars(1).nodes(1), reply.pillars(1).nodes(2)});
  EXPECT_NEAR(middle.i, 20, 1e-6);
}

TEST(Pillars, AreTriangulatedInWorldAndOnTheLattice) {
  EngineAtWork engine;
  v1::TriangulateRequest request;
  request.set_geometry_json(survey::geometry_to_json(geometry()).dump());
  request.set_fault(3);
  add_pillar(7, 10, *request.mutable_pillars());
  add_pillar(8, 30, *request.mutable_pillars());
  Context context;
  const auto reader = engine.stub->Triangulate(&context, request);
  v1::TriangulateReply reply;
  v1::Triangulation mesh;
  while (reader->Read(&reply)) {
    if (reply.has_mesh()) mesh = reply.mesh();
  }
  ASSERT_TRUE(reader->Finish().ok());
  ASSERT_GT(mesh.triangles_size(), 3);
  ASSERT_EQ(mesh.faces().corners_size(), 3 * mesh.triangles_size());
  // The corners on the lattice are the vertices in the world, rounded to 1/256 voxel.
  for (int n = 0; n < mesh.triangles_size(); ++n) {
    const int v = 3 * mesh.triangles(n);
    ASSERT_LE(v + 3, mesh.vertices_size());
    const survey::IndexPoint at =
        geometry().index_of(survey::WorldPoint{mesh.vertices(v), mesh.vertices(v + 1), mesh.vertices(v + 2)});
    EXPECT_NEAR(mesh.faces().corners(3 * n) / 256.0, at.i, 1.0 / 256);
    EXPECT_NEAR(mesh.faces().corners(3 * n + 2) / 256.0, at.k, 1.0 / 256);
  }
  EXPECT_EQ(mesh.faces().faults(0), 3);
}

TEST(Pillars, BadRequestsSayWhatIsWrong) {
  EngineAtWork engine;
  v1::TriangulateRequest request;
  const auto failure = [&] {
    Context context;
    const auto reader = engine.stub->Triangulate(&context, request);
    v1::TriangulateReply reply;
    while (reader->Read(&reply)) {
    }
    EXPECT_EQ(reader->Finish().error_code(), grpc::StatusCode::INVALID_ARGUMENT);
    return context.failure().message();
  };
  EXPECT_NE(failure().find("geometry_json"), std::string::npos);
  request.set_geometry_json("{}");
  EXPECT_NE(failure().find("geometry_json"), std::string::npos);
  request.set_geometry_json(survey::geometry_to_json(geometry()).dump());
  EXPECT_FALSE(failure().empty());
  request.add_pillars()->add_nodes(1);
  EXPECT_EQ(failure(), "pillar 0 has 1 numbers");
}

}  // namespace
}  // namespace footwall::service
