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

// What this process may use, in bytes: the least of the memory that is free, the limits of its control groups
// less what they use, and its resource limit. root: where /proc and /sys are.
struct UsableMemory {
  std::int64_t bytes = 0;
  std::int64_t machine = 0;  // that the machine has
};
UsableMemory usable_memory(const std::filesystem::path& root = "/");

}  // namespace footwall::tasks
