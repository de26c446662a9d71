#include "engine/service/resident/jobs/run_stored_task.h"

#include <nlohmann/json.hpp>

#include "engine/extract/extract.h"
#include "engine/session/attribute.h"
#include "engine/session/batch.h"
#include "engine/session/isosurface_job.h"
#include "engine/session/part_file.h"
#include "engine/session/render_job.h"
#include "mpi/service_jobs/small_volume.h"
#include "storage/base/partial_file.h"

namespace footwall::service {
namespace {

constexpr std::size_t kLimit = std::size_t{1} << 26;

class StoredTaskTest : public SmallVolume {
 protected:
  StoredTaskTest() {
    on_root([&] {
      for (const char* each : {"task/in", "task/out", "direct"})
        std::filesystem::create_directories(path / each);
    });
  }
  void on_root(const std::function<void()>& change) {
    world.collectively([&] {
      if (world.rank() == 0) change();
    });
  }
  // As the client and the server do it: rank 0 alone has the files.
  void run(const std::string& kind, const std::filesystem::path& job, const JobContext& context = {}) {
    v1::StoredTask stored;
    on_root([&] {
      packed = pack_task(kind, job);
      for (const TaskFile& each : packed.in)
        std::filesystem::copy_file(each.path, path / "task/in" / each.name);
    });
    std::string bytes;
    packed.task.SerializeToString(&bytes);
    stored.mutable_task()->ParseFromString(shared(bytes));
    stored.set_folder((path / "task").string());
    run(stored, context);
  }
  void run(const v1::StoredTask& stored, const JobContext& context = {}) {
    files.clear();
    order.clear();
    run_stored_task(
        world, stored,
        [&](const v1::VolumeName& name) {
          if (name.checksum() != checksum) throw Error(ErrorCode::kNotFound, "no such volume");
          return volume();
        },
        1,
        [&](const google::protobuf::Message& message) {
          const v1::FilePiece& piece = dynamic_cast<const v1::TaskOutput&>(message).file();
          files[piece.name()] += piece.bytes();
          if (piece.last()) order.push_back(piece.name());
        },
        context);
    if (world.rank() == 0) {
      EXPECT_TRUE(std::filesystem::is_empty(path / "task/in"));
      EXPECT_TRUE(std::filesystem::is_empty(path / "task/out"));
      EXPECT_EQ(order.back(), "result.json");
    }
  }
  std::string made(const std::filesystem::path& file) const { return read_whole_file(path / file, kLimit); }

  PackedTask packed;
  std::map<std::string, std::string> files;
  std::vector<std::string> order;
};

TEST_F(StoredTaskTest, ABatchJobBringsItsParts) {
  run("batch", path / "JOB.json");
  session::run_batch(world, path / "JOB.json", {});
  if (world.rank() != 0) return;
  for (const char* name : {"fault-1.part.h5", "fault-2.part.h5", "fault-5.part.h5"}) {
    write_whole_file(path / "direct" / name, files.at(name));  // its bytes hold the second of their making
    const session::Part came = session::read_part(path / "direct" / name);
    const session::Part wanted = session::read_part(path / "out" / name);
    EXPECT_EQ(came.hash, wanted.hash);
    EXPECT_EQ(came.faces, wanted.faces);
    EXPECT_EQ(extract::checksum_of(came.faces, came.statistics),
              extract::checksum_of(wanted.faces, wanted.statistics));
    EXPECT_EQ(packed.place_of(name), path / "out" / name);
  }
  EXPECT_EQ(nlohmann::json::parse(files.at("result.json"))["checksum"],
            nlohmann::json::parse(made("out/result.json"))["checksum"]);
  EXPECT_EQ(packed.result, path / "out/result.json");
}

TEST_F(StoredTaskTest, ABatchJobGoesOnWithTheClientsParts) {
  session::run_batch(world, path / "JOB.json", {});
  on_root([&] { write_whole_file(path / "out/fault-2.part.h5", "half a part"); });
  run("batch", path / "JOB.json");
  if (world.rank() != 0) return;
  EXPECT_EQ(order, (std::vector<std::string>{"fault-2.part.h5", "log.txt", "result.json"}));
  const auto result = nlohmann::json::parse(files.at("result.json"));
  for (const auto& part : result["parts"]) EXPECT_EQ(part["reused"], part["fault"] != 2);
  EXPECT_EQ(result["checksum"], nlohmann::json::parse(made("out/result.json"))["checksum"]);
  EXPECT_TRUE(files.at("log.txt").starts_with(made("out/log.txt")));
}

TEST_F(StoredTaskTest, AnAttributeVolumeIsTheSameFile) {
  const session::AttributeJob job{volume(), path / "direct/a.h5", path / "direct/result.json", {3, 3, 5}, {}};
  on_root([&] { session::write_attribute_job(job, path / "A.json"); });
  session::run_attribute(world, path / "A.json", {});
  run("attribute", path / "A.json");
  if (world.rank() != 0) return;
  EXPECT_TRUE(files.at("volume.h5") == made("direct/a.h5"));
  EXPECT_EQ(packed.place_of("volume.h5"), path / "direct/a.h5");
}

TEST_F(StoredTaskTest, AnIsosurfaceIsTheSameFile) {
  session::IsosurfaceJob job;
  job.volume = volume();
  job.output = path / "direct/surface.h5";
  job.result = path / "direct/result.json";
  job.value = 100;
  on_root([&] { session::write_isosurface_job(job, path / "I.json"); });
  session::run_isosurface(world, path / "I.json", {});
  run("isosurface", path / "I.json");
  if (world.rank() != 0) return;
  EXPECT_TRUE(files.at("surface.h5") == made("direct/surface.h5"));
}

TEST_F(StoredTaskTest, APictureIsTheSameLayer) {
  session::RenderJob job;
  job.width = 60;
  job.height = 50;
  const std::array<render::Vec3, 2> box{{{0, 0, 0}, {20, 14, 30}}};
  job.camera = render::Camera::look(40, 20, 1, box, 1.2, false);
  job.isosurfaces.push_back({volume(), 100, 0xff00ff00U, {}});
  job.visible.emplace();
  job.visible->pass_layers = path / "direct/pass";
  job.layer = path / "direct/layer";
  job.result = path / "direct/result.json";
  on_root([&] { session::write_render_job(job, path / "R.json"); });
  session::run_render(world, path / "R.json", {});
  run("render", path / "R.json");
  if (world.rank() != 0) return;
  EXPECT_TRUE(files.at("layer") == made("direct/layer"));
  EXPECT_TRUE(files.at("pass-1") == made("direct/pass-1"));
  EXPECT_EQ(packed.place_of("pass-12"), path / "direct/pass-12");
}

TEST_F(StoredTaskTest, NothingElseOnTheEnginesHostIsOpened) {
  session::AttributeJob job{volume(), path / "direct/a.h5", path / "direct/result.json", {3, 3, 5}, {}};
  v1::StoredTask good;
  on_root([&] {
    session::write_attribute_job(job, path / "A.json");
    packed = pack_task("attribute", path / "A.json");
  });
  std::string bytes;
  packed.task.SerializeToString(&bytes);
  good.mutable_task()->ParseFromString(shared(bytes));
  good.set_folder((path / "task").string());
  const auto with = [&](const std::string& key, const std::string& value) {
    v1::StoredTask stored = good;
    auto json = nlohmann::json::parse(stored.task().job());
    json[key] = value;
    stored.mutable_task()->set_job(json.dump());
    return stored;
  };
  for (const std::string& strange :
       {volume().string(), std::string("/etc/passwd"), std::string("@in/../../x"),
        std::string("@volume/../x"), std::string("@volume/" + checksum + "/.."), std::string("@out/.hidden"),
        std::string("")}) {
    EXPECT_EQ(code_of([&] { run(with("volume", strange)); }), ErrorCode::kInvalid) << strange;
    EXPECT_EQ(code_of([&] { run(with("output", strange)); }), ErrorCode::kInvalid) << strange;
  }
  EXPECT_EQ(code_of([&] { run(with("volume_file", "../x")); }), ErrorCode::kInvalid);
  EXPECT_EQ(code_of([&] { run(with("volume", "@volume/0123456789abcdef")); }), ErrorCode::kNotFound);
  v1::StoredTask odd = good;
  odd.mutable_task()->set_kind("shell");
  EXPECT_EQ(code_of([&] { run(odd); }), ErrorCode::kUnsupported);
  odd = good;
  odd.mutable_task()->set_job("no json");
  EXPECT_EQ(code_of([&] { run(odd); }), ErrorCode::kFormat);
  run(good);
  EXPECT_EQ(files.size(), world.rank() == 0 ? 2U : 0U);
}

TEST_F(StoredTaskTest, ACancelledOneLeavesNothing) {
  const JobContext cancelled;
  cancelled.cancel();
  EXPECT_EQ(code_of([&] { run("batch", path / "JOB.json", cancelled); }), ErrorCode::kCancelled);
  if (world.rank() == 0) {
    EXPECT_TRUE(std::filesystem::is_empty(path / "task/in"));
    EXPECT_TRUE(std::filesystem::is_empty(path / "task/out"));
  }
}

TEST_F(StoredTaskTest, LookingForACommonFolderLeavesNothing) {
  EXPECT_TRUE(all_ranks_see(world, path / "direct"));
  on_root([&] { EXPECT_TRUE(std::filesystem::is_empty(path / "direct")); });
  EXPECT_TRUE(code_of([&] { all_ranks_see(world, path / "nowhere"); }).has_value());
}

}  // namespace
}  // namespace footwall::service
