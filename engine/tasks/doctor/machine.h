// The checks that look at this machine.
#pragma once
#include <filesystem>

#include "engine/tasks/doctor/finding.h"

namespace footwall::tasks {

Finding check_cores();
Finding check_memory();
Finding check_shared_memory(const std::filesystem::path& place = "/dev/shm");
Finding check_temporary_folder();
Finding check_text();
Finding check_sqlite();

}  // namespace footwall::tasks
