// `footwall bench voxelize --table` and `--vertices`: the voxelization benchmark of seed 004 (section 5.4,
// appendices B.2 and F.3), with other voxelizers too.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/tasks/detail/voxelizer_check.h"
#include "storage/base/job_context.h"
#include "storage/survey/points.h"

namespace footwall::tasks {

using VertexTriple = std::array<survey::IndexPoint, 3>;

// "x,y,z" (inline, crossline, sample, in voxels); throws Error kUsage.
survey::IndexPoint parse_vertex(const std::string& text);

// The triangles of one triple: all combinations of the nine signs (bit 0 turns the first vertex's x, and so
// on), or the same triangle 512 times.
std::vector<survey::LatticeTriangle> sign_triangles(const VertexTriple& vertices, bool one_triangle);

// The triple of the seed's sample run, (15,12,5), (10,5,2), (4,3,6), scaled so that the triangles that
// sign_triangles makes of it have this mean area (voxel^2).
VertexTriple triple_of_mean_area(double area, bool one_triangle);

enum class VoxelOutput {
  kCoordinates,  // a list of 12-byte coordinates in memory, each visit one: what the seed timed
  kSpans         // spans consumed as they come, each voxel once: what EXTRACT-ALL uses
};

struct VoxelizeTableOptions {
  std::string voxelizer = "exact";
  VoxelOutput output = VoxelOutput::kCoordinates;
  std::vector<int> threads = {1};
  int runs = 20;
  bool one_triangle = false;
  std::vector<double> areas;             // of the rows; empty: those of the seed's tables
  std::optional<VertexTriple> vertices;  // then one row for these, whatever `areas` says
};

// One thread count and one triple; seconds are of all 512 triangles, means over the runs.
struct VoxelizeTableRow {
  double asked_area = 0;  // 0 where the vertices were given
  VertexTriple vertices{};
  int threads = 1;
  double mean_area = 0;
  double min_area = 0;
  double max_area = 0;
  std::int64_t voxels = 0;  // of one run: visits for kCoordinates
  double wall = 0;
  double user = 0;
  double system = 0;
};

struct VoxelizeTable {
  std::string voxelizer;
  std::string simd;
  VoxelOutput output = VoxelOutput::kCoordinates;
  int runs = 0;
  int triangles = 0;  // 512
  std::vector<VoxelizeTableRow> rows;
  VoxelizerCheck check;          // before the clock ran, over all rows
  VoxelDifferences differences;  // of a sample of each row; zeros for `exact`
};

// `rotated` shares out one triangle's x to the threads, as the seed does; with the others each thread takes
// whole triangles. Throws Error kUsage for options out of range, kInternal where the answer is wrong or runs
// differ, kCancelled.
VoxelizeTable bench_voxelize_table(const VoxelizeTableOptions& options, const JobContext& job);

}  // namespace footwall::tasks
