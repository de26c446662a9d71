// `footwall bench isosurface`: a raw volume through a variant, checked, counted and timed.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/isosurface/properties.h"
#include "storage/base/job_context.h"
#include "storage/survey/box.h"

namespace footwall::tasks {

struct BenchIsosurfaceOptions {
  // One of the two: a file of little-endian float32 without a header, or the name of a synthetic volume.
  std::filesystem::path raw;
  survey::Index dims{0, 0, 0};  // of the file, x, y, z: x fastest, which is our sample axis
  std::string synthetic;
  std::int64_t size = 256;          // of the synthetic volume, on each axis
  std::filesystem::path write_raw;  // where to write the volume, for other programs; empty: nowhere
  std::optional<float> value;       // none: the synthetic volume's own
  std::string variant = "bricks";
  std::string tables = "trilinear";  // or "seed", "seed000", "seed002"
  int threads = 1;
  int repeats = 5;
  bool normals = true;
  bool pyramid = false;  // skip bricks by their smallest and largest values
  bool check = true;     // against another variant, before the time counts
};

// The volume in memory.
struct BenchVolume {
  std::vector<float> values;
  survey::Index size{0, 0, 0};  // i, j, k: z, y, x of the file
  float value = 0;
  std::string name;
};
// Throws Error kUsage for options that say both or nothing, kNotFound, kFormat (another size), kIo, kMemory.
BenchVolume load_bench_volume(const BenchIsosurfaceOptions& options, const JobContext& job);

struct BenchIsosurfaceResult {
  std::string variant, tables, volume;
  survey::Index dims{0, 0, 0};  // x, y, z
  float value = 0;
  int threads = 1;
  std::string simd;
  std::vector<double> seconds;         // each repeat from released buffers, allocation included
  std::vector<double> seconds_reused;  // and with the buffers of the one before
  double median = 0, median_reused = 0;
  double cpu_seconds = 0;  // processor time of all threads, mean of the fresh repeats
  double voxels_per_second = 0, triangles_per_second = 0;  // by the median
  double input_mib = 0;
  double peak_mib = 0;                    // the most memory held above what the input takes
  std::optional<double> pyramid_seconds;  // to make the ranges of the bricks, once a volume
  std::optional<double> bricks_active;    // part of the bricks that the isovalue can cross
  isosurface::Properties properties;      // in voxels
  std::string checked_against;            // the variant; empty where the check was left out
  // With other tables than the trilinear ones.
  std::optional<std::uint64_t> undecided_cells, other_cells;
};

// Throws Error kUsage for options out of range, kInternal where the answer is wrong, what the volume's
// reading throws, kCancelled.
BenchIsosurfaceResult bench_isosurface(const BenchIsosurfaceOptions& options, const JobContext& job);

// Isovalues from first to last: seed 002's figures 6 to 9.
struct IsovalueSweep {
  float first = 0, last = 0;
  int count = 0;  // >= 1
};
struct SweepRow {
  float value = 0;
  std::uint64_t triangles = 0;
  double cubes_seconds = 0, vector_seconds = 0;  // medians
  double gain = 0;                               // cubes / vector
};
std::vector<SweepRow> sweep_isovalues(const BenchIsosurfaceOptions& options, const IsovalueSweep& sweep,
                                      const JobContext& job);

}  // namespace footwall::tasks
