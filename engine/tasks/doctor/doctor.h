// Is this machine, or this folder, fit for work? Each check is one row; none changes anything that stays.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/tasks/doctor/finding.h"
#include "storage/base/job_context.h"

namespace footwall::tasks {

struct Check {
  std::string name;
  // One finding or several (of the name of the check, or a narrower one). An exception other than kCancelled
  // becomes a failed finding.
  std::function<std::vector<Finding>(const JobContext&)> run;
};

// The machine: cores, memory, the engine under its launcher, shared memory, temporary files, the disk of
// `folder`, SQLite, text, OpenGL.
std::vector<Check> machine_checks(const std::filesystem::path& folder);

// The folder: file system, space, permissions, names, locks, flushing, a project made and held in it, the
// engine's parallel files, speed. Everything is made in a private folder inside, removed also after a cancel;
// at most 256 MiB and a tenth of the free space.
std::vector<Check> folder_checks(const std::filesystem::path& folder);

// Runs them in order. Throws kCancelled only.
std::vector<Finding> run_checks(const std::vector<Check>& checks, const JobContext& job);

}  // namespace footwall::tasks
