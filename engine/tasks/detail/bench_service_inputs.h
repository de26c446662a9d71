// The volumes that an engine is measured with.
#pragma once
#include <cstdint>
#include <filesystem>

#include "storage/base/job_context.h"
#include "storage/survey/box.h"

namespace footwall::tasks {

// Benchmark 2 of docs/workloads.md.
inline constexpr survey::Index kBenchDims{200, 200, 100};
inline constexpr double kBenchArea = 1000;
inline constexpr double kBenchDistance = 10;
inline constexpr std::int64_t kBenchFaces = 10000;
inline constexpr int kBenchMeshes = 16;
inline constexpr std::uint64_t kBenchSeed = 1;
inline constexpr std::int64_t kSphereSize = 256;

// Hashed values (workload/values.h).
void write_hashed_volume(const std::filesystem::path& path, const survey::Index& dims, const JobContext& job);
// A sphere (synthetic/fields.h); its isovalue.
float write_sphere_volume(const std::filesystem::path& path, const JobContext& job);
// A project of one hashed volume of at least so many bytes.
void make_hashed_project(const std::filesystem::path& path, std::int64_t bytes, const JobContext& job);

}  // namespace footwall::tasks
