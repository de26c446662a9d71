#include "engine/tasks/open_volume.h"

#include <fmt/format.h>

#include "storage/base/error.h"
#include "storage/base/hash.h"

namespace footwall::tasks {

volume::VolumeReader open_volume(const project::Project& project, const project::VolumeRecord& volume) {
  const std::filesystem::path path = project.volume_path(volume);
  const std::string hint =
      fmt::format("footwall relink {} FILE tells where the volume is now", project.path().string());
  std::error_code failure;
  if (!std::filesystem::exists(path, failure) && !failure) {
    throw Error(ErrorCode::kNotFound,
                fmt::format("the volume '{}' is not there: {}", volume.name, path.string()), hint);
  }
  volume::VolumeReader reader(path);
  const std::string checksum = to_hex(reader.info().checksum);
  if (checksum != volume.checksum) {
    throw Error(ErrorCode::kInvalid,
                fmt::format("{} is not the volume '{}': its checksum is {}, expected {}", path.string(),
                            volume.name, checksum, volume.checksum),
                hint);
  }
  return reader;
}

project::VolumeRecord present_volume(const project::Project& project, const std::string& name) {
  project::VolumeRecord volume = project.volume(name);
  for (const project::MissingFile& missing : project.missing()) {
    if (missing.volume != volume.name) continue;
    throw Error(ErrorCode::kNotFound,
                fmt::format("the volume '{}' {}: {}", volume.name, missing.reason, missing.path.string()),
                fmt::format("footwall relink {} FILE tells where it is now", project.path().string()));
  }
  return volume;
}

}  // namespace footwall::tasks
