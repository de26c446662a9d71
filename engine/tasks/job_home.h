// Where the files of a job are put while the engine runs it.
#pragma once
#include <filesystem>

#include "storage/project/project.h"

namespace footwall::tasks {

// Where all ranks see the job: in an allocation they may be on other hosts, which share the project's folder
// rather than this host's temporary one.
std::filesystem::path home_of_job(const project::Project& project);

}  // namespace footwall::tasks
