#include "engine/session/batch.h"

#include <gtest/gtest.h>

#include <bit>
#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/extract/extract.h"
#include "engine/session/part_file.h"
#include "engine/verify/statistics_by_definition.h"
#include "engine/verify/voxel_oracle.h"
#include "mpi/session/small_job.h"
#include "storage/base/partial_file.h"

namespace footwall::session {
namespace {

// A folder made by rank 0 with a small job in it.
class Batch : public testing::Test {
 protected:
  Batch() : world(MPI_COMM_WORLD) {
    if (world.rank() == 0) {
      folder = std::make_unique<ScratchFolder>();
      job = write_small_job(folder->path());
    }
    const std::string name = folder ? folder->path().string() : "";
    const auto raw = std::as_bytes(std::span(name));
    const comm::Bytes bytes = world.broadcast(comm::Bytes(raw.begin(), raw.end()), 0);
    path = std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  ~Batch() override { MPI_Barrier(world.get()); }

  void run() { run_batch(world, path / "JOB.json", {}); }
  nlohmann::json result() const {
    return nlohmann::json::parse(read_whole_file(path / "out" / "result.json", 1 << 24));
  }
  // Rank 0 changes something, then everyone goes on.
  void on_root(const std::function<void()>& change) {
    world.collectively([&] {
      if (world.rank() == 0) change();
    });
  }
  std::optional<Error> error_of_run() {
    try {
      run();
    } catch (const comm::AgreedError& error) {
      return error;
    }
    return std::nullopt;
  }

  comm::Communicator world;
  std::unique_ptr<ScratchFolder> folder;
  Job job;  // on rank 0
  std::filesystem::path path;
};

TEST_F(Batch, WritesTheDefinitionsNumbers) {
  run();
  if (world.rank() != 0) return;
  const nlohmann::json json = result();
  EXPECT_EQ(json["ranks"], world.size());
  EXPECT_EQ(json["exchange"], "reduce");
  EXPECT_EQ(json["faces"], 49);
  EXPECT_EQ(json["parts"].size(), 3U);

  std::vector<extract::Face> faces;
  std::vector<extract::FaceStatistics> truth;
  double max_abs = 0;
  const survey::Box survey{{0, 0, 0}, kSmallDims};
  for (std::int64_t i = 0; i < kSmallDims[0]; ++i) {
    for (std::int64_t j = 0; j < kSmallDims[1]; ++j) {
      for (std::int64_t k = 0; k < kSmallDims[2]; ++k) {
        const double value = std::abs(small_value({i, j, k}));
        if (value > max_abs) max_abs = value;
      }
    }
  }
  for (const JobFault& fault : job.faults) {
    const Part part = read_part(part_path(path / "out", fault.id));
    EXPECT_EQ(part.name, fault.name);
    ASSERT_EQ(part.faces, fault.faces);
    for (std::size_t n = 0; n < fault.faces.size(); ++n) {
      const auto voxels = verify::voxels_by_definition(fault.faces[n].triangle, survey);
      const extract::FaceStatistics& got = part.statistics[n];
      const auto want =
          verify::statistics_by_definition(voxels, kSmallDims, small_value, max_abs, got.outside);
      EXPECT_EQ(got.count, want.count);
      EXPECT_EQ(got.nulls, want.nulls);
      if (want.count > 0) {
        EXPECT_EQ(std::bit_cast<std::uint64_t>(got.variance), std::bit_cast<std::uint64_t>(want.variance));
        EXPECT_EQ(std::bit_cast<std::uint64_t>(got.discontinuity),
                  std::bit_cast<std::uint64_t>(want.discontinuity));
      }
      faces.push_back(fault.faces[n]);
      truth.push_back(want);
    }
  }
  EXPECT_EQ(json["checksum"], to_hex(extract::checksum_of(faces, truth)));
}

TEST_F(Batch, ARerunSkipsWholePartsAndMendsTheOthers) {
  run();
  nlohmann::json first;
  if (world.rank() == 0) first = result();
  on_root([&] {
    std::filesystem::resize_file(part_path(path / "out", 1), 1000);
    Job other = job;  // one face of fault 2 moves
    other.faults[1].faces[0].triangle[0].i += 512;
    write_job(other, path / "JOB.json");
  });
  run();
  on_root([&] {
    const nlohmann::json second = result();
    EXPECT_FALSE(second["parts"][0]["reused"]);
    EXPECT_FALSE(second["parts"][1]["reused"]);
    EXPECT_TRUE(second["parts"][2]["reused"]);
    EXPECT_NE(second["checksum"], first["checksum"]);
    write_job(job, path / "JOB.json");
  });
  run();
  on_root([&] {
    EXPECT_TRUE(result()["parts"][0]["reused"]);
    EXPECT_FALSE(result()["parts"][1]["reused"]);
  });
  run();
  on_root([&] {
    const nlohmann::json last = result();
    for (const auto& part : last["parts"]) EXPECT_TRUE(part["reused"]);
    EXPECT_EQ(last["checksum"], first["checksum"]);
    EXPECT_EQ(last["voxels"], first["voxels"]);
    EXPECT_EQ(last["faults"], first["faults"]);
    EXPECT_EQ(last["faults"].size(), 3U);
    EXPECT_GT(last["faults"][0]["count"], 0);
    EXPECT_TRUE(last["faults"][2]["mean"].is_null());  // a fault without faces
    for (const auto& entry : std::filesystem::directory_iterator(path / "out")) {
      EXPECT_TRUE(entry.path().extension() == ".h5" || entry.path().filename() == "result.json" ||
                  entry.path().filename() == "log.txt")
          << entry.path();
    }
  });
}

TEST_F(Batch, AStoppedJobKeepsTheFaultsThatAreDone) {
  const std::vector<extract::Face> faces = small_faces(1, 20000);
  on_root([&] {
    Job big = job;
    big.faults.clear();
    for (const std::int64_t id : {1, 2, 3}) {
      big.faults.push_back({id, "fault " + std::to_string(id), faces});
      for (extract::Face& face : big.faults.back().faces) face.fault = id;
    }
    write_job(big, path / "JOB.json");
  });
  const auto parts_there = [&] {
    int there = 0;
    for (const std::int64_t id : {1, 2, 3})
      there += std::filesystem::exists(part_path(path / "out", id)) ? 1 : 0;
    return there;
  };
  // Every rank asks to stop as soon as the first part is there.
  JobContext* running = nullptr;
  JobContext context([&](const Progress&) {
    if (parts_there() > 0) running->cancel();
  });
  running = &context;
  try {
    run_batch(world, path / "JOB.json", context);
    ADD_FAILURE() << "it was not stopped";
  } catch (const comm::AgreedError& error) {
    EXPECT_EQ(error.code(), ErrorCode::kCancelled);
  }
  EXPECT_EQ(parts_there(), 1);
  EXPECT_FALSE(std::filesystem::exists(path / "out" / "result.json"));
  nlohmann::json checksum;    // on rank 0
  world.collectively([] {});  // nobody goes on before all have looked
  run();
  on_root([&] {
    const nlohmann::json json = result();
    EXPECT_TRUE(json["parts"][0]["reused"]);
    EXPECT_FALSE(json["parts"][1]["reused"]);
    EXPECT_EQ(json["faces"], 60000);
    checksum = json["checksum"];
    std::filesystem::remove_all(path / "out");
  });
  run();
  on_root([&] {
    EXPECT_FALSE(result()["parts"][0]["reused"]);
    EXPECT_EQ(result()["checksum"], checksum);
  });
}

TEST_F(Batch, TheVolumeMayBeElsewhere) {
  on_root([&] { std::filesystem::rename(path / "volume.h5", path / "moved.h5"); });
  EXPECT_EQ(error_of_run()->code(), ErrorCode::kNotFound);
  run_batch(world, path / "JOB.json", {}, {path / "moved.h5", 2});
  on_root([&] { EXPECT_EQ(result()["threads"], 2); });
}

TEST_F(Batch, OneWriterWritesTheSameParts) {
  run();
  std::string checksum;
  on_root([&] {
    checksum = result()["checksum"];
    std::filesystem::remove_all(path / "out");
  });
  BatchOptions options;
  options.one_writer = true;
  run_batch(world, path / "JOB.json", {}, options);
  on_root([&] { EXPECT_EQ(result()["checksum"], checksum); });
  // Parts are found again, whoever wrote them.
  const auto expect_reused = [&] {
    for (const auto& part : result()["parts"]) EXPECT_TRUE(part["reused"].get<bool>());
  };
  run_batch(world, path / "JOB.json", {}, options);
  on_root(expect_reused);
  run();
  on_root(expect_reused);
}

TEST_F(Batch, TroubleIsTheSameErrorOnAllRanks) {
  const auto expect = [&](ErrorCode code, const std::string& words) {
    const std::optional<Error> error = error_of_run();
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->code(), code) << error->what();
    EXPECT_NE(error->message().find(words), std::string::npos) << error->what();
    EXPECT_FALSE(std::filesystem::exists(path / "out" / "result.json"));
  };
  const auto with = [&](const std::function<void(Job&)>& change) {
    on_root([&] {
      Job other = job;
      change(other);
      write_job(other, path / "JOB.json");
    });
  };
  with([](Job& j) { j.volume_checksum = "0123456789abcdef"; });
  expect(ErrorCode::kInvalid, "checksum");
  with([](Job& j) { j.geometry.interval = 2; });
  expect(ErrorCode::kInvalid, "by 2");
  with([](Job& j) { j.options.exchange = "pushing"; });
  expect(ErrorCode::kUsage, "push");
  with([](Job& j) { j.volume = "gone.h5"; });
  expect(ErrorCode::kNotFound, "gone.h5");
  on_root([&] { write_whole_file(path / "JOB.json", "{"); });
  expect(ErrorCode::kFormat, "JOB.json");
  with([](Job&) {});
  on_root([&] { std::filesystem::resize_file(path / "volume.h5", 3000); });
  const std::optional<Error> error = error_of_run();
  ASSERT_TRUE(error.has_value());
}

}  // namespace
}  // namespace footwall::session
