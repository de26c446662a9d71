#include "storage/surface/surface_writer_parallel.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <vector>

#include "mpi/volume/shared_folder.h"
#include "storage/base/error.h"

namespace footwall::surface {
namespace {

constexpr std::uint64_t kVertices = 50;
constexpr std::uint64_t kTriangles = 31;

std::uint64_t bound(std::uint64_t all, int rank, int ranks) {
  return all * static_cast<std::uint64_t>(rank) / static_cast<std::uint64_t>(ranks);
}

class SurfaceWriter : public volume::SharedFolder {
 protected:
  void SetUp() override {
    SharedFolder::SetUp();
    for (std::uint64_t v = bound(kVertices, rank_, ranks_); v < bound(kVertices, rank_ + 1, ranks_); ++v) {
      for (int axis = 0; axis < 3; ++axis) {
        world.push_back(1e6 + static_cast<double>(v) + 0.125 * axis);
        normals.push_back(static_cast<float>(v) * 0.5F);
      }
    }
    for (std::uint64_t t = bound(kTriangles, rank_, ranks_); t < bound(kTriangles, rank_ + 1, ranks_); ++t) {
      for (std::uint64_t corner = 0; corner < 3; ++corner)
        triangles.push_back(static_cast<std::uint32_t>((t + corner) % kVertices));
    }
    share.first_vertex = bound(kVertices, rank_, ranks_);
    share.first_triangle = bound(kTriangles, rank_, ranks_);
    share.world_positions = world;
    share.normals = normals;
    share.triangles = triangles;
  }

  std::vector<double> world;
  std::vector<float> normals;
  std::vector<std::uint32_t> triangles;
  SurfaceShare share;
  SurfaceSize size{kVertices, kTriangles, true, true};
};

ErrorCode code_of(const std::filesystem::path& path) {
  try {
    read_surface(path);
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::kInternal;
}

TEST_F(SurfaceWriter, WhatAllRanksWriteIsReadBack) {
  write_surface_parallel(MPI_COMM_WORLD, folder_ / "s.h5", size, R"({"a":1})", share);
  if (rank_ != 0) return;
  const StoredSurface found = read_surface(folder_ / "s.h5");
  EXPECT_EQ(found.description, R"({"a":1})");
  EXPECT_TRUE(found.world);
  ASSERT_EQ(found.positions.size(), 3 * kVertices);
  ASSERT_EQ(found.triangles.size(), 3 * kTriangles);
  EXPECT_EQ(found.positions[3 * 49 + 1], 1e6 + 49.125);
  EXPECT_EQ(found.normals[3 * 20], 10.0F);
  EXPECT_EQ(found.triangles[3 * 30 + 2], 32U);
}

TEST_F(SurfaceWriter, DamagedFilesAreRefused) {
  write_surface_parallel(MPI_COMM_WORLD, folder_ / "s.h5", size, "{}", share);
  triangles.assign(triangles.size(), 50);  // one beyond the last vertex
  write_surface_parallel(MPI_COMM_WORLD, folder_ / "beyond.h5", size, "{}", share);
  if (rank_ != 0) return;
  EXPECT_EQ(code_of(folder_ / "gone.h5"), ErrorCode::kNotFound);
  EXPECT_EQ(code_of(folder_ / "beyond.h5"), ErrorCode::kFormat);
  std::ofstream(folder_ / "text.h5") << "not HDF5 at all";
  EXPECT_EQ(code_of(folder_ / "text.h5"), ErrorCode::kCorrupt);
  std::filesystem::resize_file(folder_ / "s.h5", std::filesystem::file_size(folder_ / "s.h5") - 8);
  const ErrorCode cut = code_of(folder_ / "s.h5");
  EXPECT_TRUE(cut == ErrorCode::kFormat || cut == ErrorCode::kCorrupt);
}

TEST_F(SurfaceWriter, AFolderThatIsNotThereIsTheSameErrorOnAllRanks) {
  same_error(ErrorCode::kNotFound,
             [&] { write_surface_parallel(MPI_COMM_WORLD, folder_ / "none" / "s.h5", size, "{}", share); });
}

}  // namespace
}  // namespace footwall::surface
