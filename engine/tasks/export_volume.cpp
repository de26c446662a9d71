#include "engine/tasks/export_volume.h"

#include <cmath>

#include "engine/tasks/open_volume.h"
#include "storage/formats/nrrd.h"
#include "storage/formats/vti.h"

namespace footwall::tasks {
namespace {

volume::VolumeReader opened(const project::Project& project, const std::string& name) {
  return open_volume(project, project.volume(name));
}

auto boxes_of(const volume::VolumeReader& reader) {
  return [&reader](const survey::Box& box, std::span<float> values) { reader.read(box, values); };
}

}  // namespace

std::int64_t export_raw(const project::Project& project, const std::string& volume,
                        const std::filesystem::path& file, const formats::raw::WriteOptions& options,
                        const JobContext& job) {
  const volume::VolumeReader reader = opened(project, volume);
  const volume::VolumeInfo& info = reader.info();
  const auto read = [&](const survey::Box& box, std::span<float> values) {
    reader.read(box, values);
    if (!info.null_value) return;
    for (float& value : values) {
      if (std::isnan(value)) value = *info.null_value;
    }
  };
  formats::raw::write(file, info.dims, read, info.chunk[static_cast<std::size_t>(options.order[0])], job,
                      options);
  return info.dims[0] * info.dims[1] * info.dims[2];
}

void export_nrrd(const project::Project& project, const std::string& volume,
                 const std::filesystem::path& file, const formats::raw::AxisOrder& order,
                 const JobContext& job) {
  const volume::VolumeReader reader = opened(project, volume);
  formats::nrrd::write(file, reader.info().geometry, order, project.volume(volume).name, boxes_of(reader),
                       job);
}

void export_vti(const project::Project& project, const std::string& volume, const std::filesystem::path& file,
                bool z_up, const JobContext& job) {
  const volume::VolumeReader reader = opened(project, volume);
  formats::vti::write(file, reader.info().geometry, boxes_of(reader), {project.volume(volume).name, z_up},
                      job);
}

formats::segy::Written export_segy(const project::Project& project, const std::string& volume,
                                   const std::filesystem::path& file, const SegyExport& options,
                                   const JobContext& job) {
  const volume::VolumeReader reader = opened(project, volume);
  const volume::VolumeInfo& info = reader.info();
  formats::segy::WriteOptions how;
  how.format = options.format;
  how.holes = options.holes;
  how.null_value = options.null_value;
  how.title = project.volume(volume).name + " of " + project.path().filename().string();
  how.source = info.source;
  return formats::segy::write(file, info.geometry, reader.live_mask(), boxes_of(reader), info.chunk[0], how,
                              job);
}

}  // namespace footwall::tasks
