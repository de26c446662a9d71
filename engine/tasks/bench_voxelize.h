// `footwall bench voxelize`: a file of triangles through a voxelizer, checked, counted and timed.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/tasks/detail/voxelizer_check.h"
#include "storage/base/job_context.h"
#include "storage/survey/points.h"

namespace footwall::tasks {

// Triangles as text, one a line: nine numbers i0,j0,k0,i1,j1,k1,i2,j2,k2 in index space (inline, crossline,
// sample; voxel units, voxel (i,j,k) is centred on the integers), separated by commas, semicolons or blanks.
// Lines that are empty or begin with '#' are skipped, and so is a first line of words; CRLF is taken.
// Positions are rounded to the lattice by survey::Lattice. Throws Error kFormat or kInvalid with line and
// column, kNotFound, kIo.
std::vector<survey::LatticeTriangle> read_triangles_csv(const std::filesystem::path& path);
std::vector<survey::LatticeTriangle> parse_triangles_csv(std::string_view text, std::string_view name);

struct BenchVoxelizeOptions {
  std::filesystem::path triangles;
  std::string voxelizer = "exact";
  int threads = 1;             // >= 1
  int repeats = 5;             // >= 1; `seconds` is the median
  std::filesystem::path list;  // where to write "triangle,i,j,k" lines (triangles from 0); empty: nowhere
};

struct BenchVoxelizeResult {
  std::string voxelizer;
  std::string simd;  // the instruction set in use
  int threads = 1;
  std::int64_t triangles = 0;
  std::int64_t voxels = 0;           // sum of counts
  std::vector<std::int64_t> counts;  // per triangle, in the file's order
  std::vector<double> seconds_each;  // of every repeat
  double seconds = 0;                // their median
  double seconds_min = 0;
  double seconds_max = 0;
  double voxels_per_second = 0;  // by the median; 0 where nothing was to do
  VoxelizerCheck check;          // before the clock ran
  bool exact = true;             // whether the method is to find what `exact` finds
  VoxelDifferences differences;  // of all triangles where it is not; zeros where it is
};

// Throws Error kUsage for options out of range or a voxelizer that is not built, kInternal if the answer is
// wrong, kCancelled between triangles, and what reading and writing the files throws.
BenchVoxelizeResult bench_voxelize(const BenchVoxelizeOptions& options, const JobContext& job);

}  // namespace footwall::tasks
