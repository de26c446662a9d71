#include "engine/tasks/detail/bench_service_inputs.h"

#include <algorithm>

#include "engine/synthetic/fields.h"
#include "engine/tasks/new_project.h"
#include "engine/tasks/workload/values.h"
#include "storage/volume/volume_writer.h"

namespace footwall::tasks {
namespace {

survey::Geometry geometry_of(const survey::Index& dims) {
  return plain_geometry(dims, survey::Domain::kDepth, survey::VerticalUnit::kMetre, 1);
}

volume::BlockSource hashed(const survey::Index& dims) {
  return [dims](const survey::Box& box, std::span<float> values, std::span<std::uint8_t>) {
    fill_hashed(dims, kBenchSeed, box, values);
  };
}

}  // namespace

void write_hashed_volume(const std::filesystem::path& path, const survey::Index& dims,
                         const JobContext& job) {
  volume::WriteOptions how;
  how.geometry = geometry_of(dims);
  volume::write_volume(path, how, hashed(dims), job);
}

float write_sphere_volume(const std::filesystem::path& path, const JobContext& job) {
  const synthetic::SampledField sphere = synthetic::make_field("sphere", kSphereSize);
  volume::WriteOptions how;
  how.geometry = geometry_of({kSphereSize, kSphereSize, kSphereSize});
  volume::write_volume(
      path, how,
      [&](const survey::Box& box, std::span<float> values, std::span<std::uint8_t>) {
        auto to = values.begin();
        for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
          for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
            const std::int64_t from = (i * kSphereSize + j) * kSphereSize + box.lo[2];
            to = std::copy_n(sphere.values.begin() + from, box.hi[2] - box.lo[2], to);
          }
        }
      },
      job);
  return sphere.isovalue;
}

void make_hashed_project(const std::filesystem::path& path, std::int64_t bytes, const JobContext& job) {
  constexpr std::int64_t kTraces = 512;
  constexpr std::int64_t kSection = kTraces * kTraces * static_cast<std::int64_t>(sizeof(float));
  const survey::Index dims{kTraces, kTraces, std::max<std::int64_t>(2, (bytes + kSection - 1) / kSection)};
  VolumeSource source;
  source.geometry = geometry_of(dims);
  source.fill = hashed(dims);
  source.text = "hashed values";
  new_project(path, "hashed", source, job);
}

}  // namespace footwall::tasks
