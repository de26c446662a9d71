// The memory that this process may use.
#pragma once
#include <cstdint>
#include <filesystem>

namespace footwall {

// In bytes: the least of the memory that is free, the limits of the process's control groups less what they
// use, and its resource limit. root: where /proc and /sys are.
struct UsableMemory {
  std::int64_t bytes = 0;
  std::int64_t machine = 0;  // that the machine has
};
UsableMemory usable_memory(const std::filesystem::path& root = "/");

}  // namespace footwall
