#include "engine/tasks/relink.h"

#include <fmt/format.h>

#include <algorithm>

#include "storage/base/error.h"
#include "storage/base/hash.h"
#include "storage/volume/volume_reader.h"

namespace footwall::tasks {

std::string relink_volume(project::Project& project, const std::string& volume,
                          const std::filesystem::path& file) {
  const std::string checksum = to_hex(volume::VolumeReader(file).info().checksum);
  // Of several equal volumes the one that is missing is meant.
  std::string chosen;
  const std::vector<project::MissingFile> missing = project.missing();
  for (const project::VolumeRecord& record : project.volumes()) {
    if (volume.empty() ? record.checksum != checksum : record.name != volume) continue;
    const bool lost = std::any_of(missing.begin(), missing.end(),
                                  [&](const project::MissingFile& m) { return m.volume == record.name; });
    if (chosen.empty() || lost) chosen = record.name;
    if (lost) break;
  }
  if (!chosen.empty()) {
    project.relink(chosen, file, checksum);
    return chosen;
  }
  if (!volume.empty()) project.volume(volume);  // says which names there are
  throw Error(ErrorCode::kNotFound,
              fmt::format("{} is none of the project's volumes: its checksum is {}", file.string(), checksum),
              "footwall info lists the volumes with their checksums");
}

}  // namespace footwall::tasks
