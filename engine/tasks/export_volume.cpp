#include "engine/tasks/export_volume.h"

#include <cmath>

#include "engine/tasks/open_volume.h"
#include "storage/formats/raw.h"

namespace footwall::tasks {

std::int64_t export_raw(const project::Project& project, const std::string& volume,
                        const std::filesystem::path& file, const JobContext& job) {
  const volume::VolumeReader reader = open_volume(project, project.volume(volume));
  const volume::VolumeInfo& info = reader.info();
  const auto read = [&](const survey::Box& box, std::span<float> values) {
    reader.read(box, values);
    if (!info.null_value) return;
    for (float& value : values) {
      if (std::isnan(value)) value = *info.null_value;
    }
  };
  formats::raw::write(file, info.dims, read, info.chunk[0], job);
  return info.dims[0] * info.dims[1] * info.dims[2];
}

}  // namespace footwall::tasks
