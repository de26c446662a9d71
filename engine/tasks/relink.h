// Points a project's volume to where its file went.
#pragma once
#include <filesystem>
#include <string>

#include "storage/project/project.h"

namespace footwall::tasks {

// volume: empty for the one whose checksum the file has (a missing one first). Refuses a file that is not
// that volume. Returns the volume's name.
std::string relink_volume(project::Project& project, const std::string& volume,
                          const std::filesystem::path& file);

}  // namespace footwall::tasks
