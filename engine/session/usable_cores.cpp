#include <sched.h>

#include <cmath>
#include <fstream>

#include "engine/session/launch.h"
#include "engine/session/launcher.h"
#include "storage/base/text.h"

namespace footwall::session {
namespace {

int affinity_cores() {
  // Room for machines with more than 1024 processors.
  constexpr int kMost = 1 << 16;
  cpu_set_t* set = CPU_ALLOC(kMost);
  if (set == nullptr) return 1;
  const std::size_t size = CPU_ALLOC_SIZE(kMost);
  CPU_ZERO_S(size, set);
  const int cores = sched_getaffinity(0, size, set) == 0 ? CPU_COUNT_S(size, set) : 1;
  CPU_FREE(set);
  return std::max(cores, 1);
}

std::vector<std::string> words_of(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  std::vector<std::string> words;
  for (const std::string_view word : text::words(line)) words.emplace_back(word);
  return words;
}

std::optional<int> cores_of_quota(std::optional<double> quota, std::optional<double> period) {
  if (!quota || !period || !(*quota > 0) || !(*period > 0)) return std::nullopt;
  return static_cast<int>(std::clamp(std::ceil(*quota / *period), 1.0, 65536.0));
}

// cgroup version 2, then version 1, as seen from inside a container.
std::optional<int> quota_cores() {
  const auto unified = words_of("/sys/fs/cgroup/cpu.max");
  if (unified.size() == 2) return cores_of_quota(text::number(unified[0]), text::number(unified[1]));
  const auto quota = words_of("/sys/fs/cgroup/cpu/cpu.cfs_quota_us");
  const auto period = words_of("/sys/fs/cgroup/cpu/cpu.cfs_period_us");
  if (quota.size() == 1 && period.size() == 1)
    return cores_of_quota(text::number(quota[0]), text::number(period[0]));
  return std::nullopt;
}

}  // namespace

int usable_cores() {
  return std::min(affinity_cores(), quota_cores().value_or(1 << 16));
}

int default_ranks() {
  return current_allocation().tasks.value_or(std::min(4, usable_cores()));
}

int default_threads() {
  return current_allocation().cpus_per_task.value_or(1);
}

}  // namespace footwall::session
