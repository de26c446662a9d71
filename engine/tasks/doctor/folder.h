// The checks that look at one folder; `place` is a private folder inside it, which the caller removes.
#pragma once
#include <filesystem>

#include "engine/tasks/doctor/finding.h"

namespace footwall::tasks {

Finding check_file_system(const std::filesystem::path& folder);
Finding check_space(const std::filesystem::path& folder);
// Whether a name with letters beyond ASCII comes back as it was given, and how large a file may be.
Finding check_names(const std::filesystem::path& place);
// fcntl, flock and hard links between two processes, as SQLite, the local lock and the lease use them.
Finding check_locks(const std::filesystem::path& place);
Finding check_rename(const std::filesystem::path& place);
Finding check_flush(const std::filesystem::path& place);
// Makes a project, edits it, reads along, and has a second writer refused.
Finding check_project(const std::filesystem::path& place);
Finding check_speed(const std::filesystem::path& place, const JobContext& job);

}  // namespace footwall::tasks
