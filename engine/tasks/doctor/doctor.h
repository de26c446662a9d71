// Is this machine, or this folder, fit for work? Nothing that is made for it stays, also after a cancel.
#pragma once
#include <filesystem>
#include <vector>

#include "engine/session/launch.h"
#include "engine/tasks/doctor/finding.h"
#include "storage/base/job_context.h"

namespace footwall::tasks {

// The machine: cores, memory, the engine on two ranks under its launcher, how many ranks
// and threads to use, shared memory, temporary files, the
// disk of `folder`, SQLite, text, OpenGL. Throws kCancelled only: what goes wrong is a finding.
std::vector<Finding> check_machine(const std::filesystem::path& folder, const session::LaunchOptions& launch,
                                   const JobContext& job);

// The folder: file system, space, permissions, names, locks, renaming, flushing, a project made and held in
// it, the engine's parallel files, speed (at most 256 MiB and a tenth of the free space). Throws kCancelled
// only.
std::vector<Finding> check_folder(const std::filesystem::path& folder, const session::LaunchOptions& launch,
                                  const JobContext& job);

}  // namespace footwall::tasks
