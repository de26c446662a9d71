#include "engine/session/isosurface_job.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "engine/isosurface/plane.h"
#include "mpi/isosurface/volume_in_memory.h"
#include "scratch_folder.h"
#include "storage/base/partial_file.h"
#include "storage/surface/surface_file.h"
#include "storage/volume/volume_writer.h"

namespace footwall::session {
namespace {

using isosurface::TestVolume;

// A folder made by rank 0 with a volume in it.
class IsosurfaceJobs : public testing::Test {
 protected:
  IsosurfaceJobs() : world(MPI_COMM_WORLD), volume{{37, 30, 41}, isosurface::rough(7, 0.01)} {
    if (world.rank() == 0) {
      folder = std::make_unique<ScratchFolder>();
      volume::WriteOptions options;
      options.geometry.inlines.count = volume.dims[0];
      options.geometry.crosslines.count = volume.dims[1];
      options.geometry.samples = volume.dims[2];
      options.geometry.map = {1000, 2000, 0, 25, 12.5, 0};
      const auto fill = [&](const survey::Box& box, std::span<float> values, std::span<std::uint8_t>) {
        const std::vector<float> made = volume.samples(box);
        std::copy(made.begin(), made.end(), values.begin());
      };
      volume::write_volume(*folder / "volume.h5", options, fill, {});
    }
    const std::string name = folder ? folder->path().string() : "";
    const auto raw = std::as_bytes(std::span(name));
    const comm::Bytes bytes = world.broadcast(comm::Bytes(raw.begin(), raw.end()), 0);
    path = std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  ~IsosurfaceJobs() override { MPI_Barrier(world.get()); }

  void run(const std::function<void(IsosurfaceJob&)>& change, const JobContext& context = {}) {
    IsosurfaceJob job;
    job.volume = path / "volume.h5";
    job.output = path / "surface.h5";
    job.result = path / "result.json";
    change(job);
    world.collectively([&] {
      if (world.rank() == 0) write_isosurface_job(job, path / "ISOSURFACE.json");
    });
    run_isosurface(world, path / "ISOSURFACE.json", context);
  }
  ErrorCode code_of(const std::function<void(IsosurfaceJob&)>& change, const JobContext& context = {}) {
    try {
      run(change, context);
    } catch (const comm::AgreedError& error) {
      return error.code();
    }
    return ErrorCode::kInternal;
  }
  // On rank 0.
  std::string bytes_of(const char* name) const { return content_of(path / name); }

  comm::Communicator world;
  TestVolume volume;
  std::unique_ptr<ScratchFolder> folder;
  std::filesystem::path path;
};

TEST_F(IsosurfaceJobs, TheFileIsTheSerialSurface) {
  run([](IsosurfaceJob&) {});
  if (world.rank() != 0) return;
  std::vector<float> room;
  isosurface::Surface expected;
  isosurface::extract_plane(volume.whole(room), 0, {}, expected);
  const surface::StoredSurface found = surface::read_surface(path / "surface.h5");
  EXPECT_FALSE(found.world);
  ASSERT_EQ(found.positions.size(), 3 * expected.positions.size());
  ASSERT_EQ(found.triangles.size(), 3 * expected.triangles.size());
  for (std::size_t v = 0; v < expected.positions.size(); ++v) {
    const isosurface::Point& p = expected.positions[v];
    ASSERT_EQ(found.positions[3 * v], p.i);
    ASSERT_EQ(found.positions[3 * v + 2], p.k);
    ASSERT_EQ(found.normals[3 * v + 1], expected.normals[v].j);
  }
  for (std::size_t t = 0; t < expected.triangles.size(); ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner)
      ASSERT_EQ(found.triangles[3 * t + corner], expected.triangles[t][corner]);
  }
  const auto result = nlohmann::json::parse(bytes_of("result.json"));
  EXPECT_EQ(result["triangles"], expected.triangles.size());
  EXPECT_EQ(result["ranks"], world.size());
  EXPECT_EQ(result["unit"], "voxel");
}

TEST_F(IsosurfaceJobs, PillarsDoNotChangeAByte) {
  std::string first;
  for (const auto& pillars : {isosurface::Interleaving{1, 1, 1}, {3, 2, 1}, {2, 2, 3}}) {
    for (const bool capped : {false, true}) {
      run([&](IsosurfaceJob& job) {
        job.pillars = pillars;
        job.cap = capped;
        job.largest = 3;
        job.output = path / (capped ? "capped.h5" : "open.h5");
      });
    }
    if (world.rank() != 0) continue;
    const std::string now = bytes_of("open.h5") + bytes_of("capped.h5");
    if (!first.empty()) {
      EXPECT_TRUE(now == first);
    }
    first = now;
  }
}

// X east, Y north and z down are left-handed as written: triangles are turned over, so that they run
// counter-clockwise as seen from where the normals point.
TEST_F(IsosurfaceJobs, WorldCoordinatesAreTheSurveysAndWindingFollowsNormals) {
  run([](IsosurfaceJob& job) { job.world = true; });
  if (world.rank() != 0) return;
  const surface::StoredSurface found = surface::read_surface(path / "surface.h5");
  EXPECT_TRUE(found.world);
  std::int64_t along = 0;
  std::int64_t all = 0;
  for (std::size_t t = 0; t + 2 < found.triangles.size(); t += 3, ++all) {
    std::array<std::array<double, 3>, 3> p;
    std::array<double, 3> n{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        p[corner][axis] = found.positions[3 * found.triangles[t + corner] + axis];
        n[axis] += static_cast<double>(found.normals[3 * found.triangles[t + corner] + axis]);
      }
    }
    const auto side = [&](std::size_t corner, std::size_t axis) { return p[corner][axis] - p[0][axis]; };
    const double dot = n[0] * (side(1, 1) * side(2, 2) - side(1, 2) * side(2, 1)) +
                       n[1] * (side(1, 2) * side(2, 0) - side(1, 0) * side(2, 2)) +
                       n[2] * (side(1, 0) * side(2, 1) - side(1, 1) * side(2, 0));
    along += dot > 0 ? 1 : 0;
    EXPECT_GE(p[0][0], 1000);
    EXPECT_LE(p[0][0], 1000 + 12.5 * 29);
    EXPECT_GE(p[0][1], 2000);
  }
  EXPECT_GT(along, all * 3 / 4);  // so rough a field turns quicker than its triangles
}

TEST_F(IsosurfaceJobs, TroubleIsTheSameErrorOnAllRanksAndLeavesNoFile) {
  EXPECT_EQ(code_of([&](IsosurfaceJob& job) { job.volume = path / "gone.h5"; }), ErrorCode::kNotFound);
  EXPECT_EQ(code_of([&](IsosurfaceJob& job) { job.output = path / "no such folder" / "s.h5"; }),
            ErrorCode::kNotFound);
  EXPECT_EQ(code_of([](IsosurfaceJob& job) { job.variant = "none"; }), ErrorCode::kUsage);
  const JobContext cancelled;
  if (world.rank() == world.size() - 1) cancelled.cancel();
  EXPECT_EQ(code_of([](IsosurfaceJob&) {}, cancelled), ErrorCode::kCancelled);
  EXPECT_FALSE(std::filesystem::exists(path / "surface.h5"));
  EXPECT_FALSE(std::filesystem::exists(path / "result.json"));
}

TEST_F(IsosurfaceJobs, AnEmptySurfaceIsAFileToo) {
  run([](IsosurfaceJob& job) {
    job.value = 1e6F;
    job.cap = true;
  });
  if (world.rank() != 0) return;
  const surface::StoredSurface found = surface::read_surface(path / "surface.h5");
  EXPECT_TRUE(found.positions.empty());
  EXPECT_TRUE(found.triangles.empty());
}

}  // namespace
}  // namespace footwall::session
