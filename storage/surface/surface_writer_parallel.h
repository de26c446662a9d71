// Writes a surface file by N ranks at once, each its own part of every dataset.
#pragma once
#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "storage/surface/surface_file.h"

namespace footwall::surface {

struct SurfaceSize {
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  bool world = false;  // positions are float64
  bool normals = false;
};

// What one rank brings: the shares of all ranks follow each other without gaps. Three values a row.
struct SurfaceShare {
  std::uint64_t first_vertex = 0;
  std::uint64_t first_triangle = 0;
  std::span<const float> positions;         // in index space, or
  std::span<const double> world_positions;  // in the world
  std::span<const float> normals;
  std::span<const std::uint32_t> triangles;
};

// Collective over comm (duplicated; ranks need the same path, size and description). Rank 0 makes the file
// and HDF5's tables; each rank writes its rows where HDF5 has made room for them. The bytes are the same for
// any number of ranks. The file takes its name when it is whole and on the disk; a failure on any rank leaves
// none and throws the same Error on all: kNotFound (folder), kIo.
void write_surface_parallel(MPI_Comm comm, const std::filesystem::path& path, const SurfaceSize& size,
                            const std::string& description, const SurfaceShare& share);

}  // namespace footwall::surface
