// What processes of this machine used so far, as the system counts it.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace footwall::tasks {

// Processor seconds of each, user and system, of all threads that live. Throws std::filesystem_error where a
// process is gone.
std::vector<double> processor_seconds(std::span<const int> processes);
// Resident bytes of each; 0 where it is gone.
std::vector<std::int64_t> resident_bytes(std::span<const int> processes);
// Who started it; 0 where it is gone.
int parent_of(int process);

}  // namespace footwall::tasks
