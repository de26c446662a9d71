#include "engine/tasks/process_use.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace footwall::tasks {

std::vector<double> processor_seconds(std::span<const int> processes) {
  std::vector<double> all;
  for (const int process : processes) {
    // Nanoseconds on a processor of each thread: finer than the ticks of /proc/PID/stat.
    double nanoseconds = 0;
    const std::filesystem::path tasks = fmt::format("/proc/{}/task", process);
    for (const auto& task : std::filesystem::directory_iterator(tasks)) {
      std::ifstream file(task.path() / "schedstat");
      double of_thread = 0;
      file >> of_thread;
      nanoseconds += of_thread;
    }
    all.push_back(nanoseconds * 1e-9);
  }
  return all;
}

std::vector<std::int64_t> resident_bytes(std::span<const int> processes) {
  std::vector<std::int64_t> all;
  for (const int process : processes) {
    std::ifstream file(fmt::format("/proc/{}/statm", process));
    std::int64_t whole = 0;
    std::int64_t resident = 0;
    file >> whole >> resident;
    all.push_back(resident * sysconf(_SC_PAGESIZE));
  }
  return all;
}

int parent_of(int process) {
  std::ifstream file(fmt::format("/proc/{}/status", process));
  constexpr std::string_view kParent = "PPid:";
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(kParent)) return std::stoi(line.substr(kParent.size()));
  }
  return 0;
}

}  // namespace footwall::tasks
