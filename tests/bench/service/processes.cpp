#include "bench/service/processes.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace footwall::service {

std::vector<double> processor_seconds(std::span<const RankFacts> ranks) {
  std::vector<double> all;
  for (const RankFacts& rank : ranks) {
    // Nanoseconds on a processor of each thread: finer than the ticks of /proc/PID/stat.
    double nanoseconds = 0;
    const std::filesystem::path tasks = fmt::format("/proc/{}/task", rank.process);
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

std::int64_t most_memory(std::span<const RankFacts> ranks) {
  std::int64_t most = 0;
  for (const RankFacts& rank : ranks) {
    std::ifstream file(fmt::format("/proc/{}/statm", rank.process));
    std::int64_t whole = 0;
    std::int64_t resident = 0;
    file >> whole >> resident;
    most = std::max(most, resident * sysconf(_SC_PAGESIZE));
  }
  return most;
}

}  // namespace footwall::service
