#include "storage/base/cores.h"

#include <sched.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <numeric>
#include <string>

#include "storage/base/text.h"

namespace footwall {
namespace {

// Room for machines with more than 1024 processors.
constexpr int kMostProcessors = 1 << 16;
constexpr int kBits = 64;

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
  return static_cast<int>(std::clamp(std::ceil(*quota / *period), 1.0, double{kMostProcessors}));
}

}  // namespace

std::vector<std::uint64_t> affinity_mask() {
  std::vector<std::uint64_t> words(kMostProcessors / kBits, 0);
  cpu_set_t* set = CPU_ALLOC(kMostProcessors);
  if (set != nullptr) {
    const std::size_t size = CPU_ALLOC_SIZE(kMostProcessors);
    CPU_ZERO_S(size, set);
    if (sched_getaffinity(0, size, set) == 0) {
      for (int n = 0; n < kMostProcessors; ++n) {
        if (CPU_ISSET_S(static_cast<std::size_t>(n), size, set))
          words[static_cast<std::size_t>(n / kBits)] |= std::uint64_t{1} << (n % kBits);
      }
    }
    CPU_FREE(set);
  }
  if (std::all_of(words.begin(), words.end(), [](std::uint64_t word) { return word == 0; })) words[0] = 1;
  return words;
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

int usable_cores() {
  const std::vector<std::uint64_t> mask = affinity_mask();
  const int allowed = std::accumulate(mask.begin(), mask.end(), 0,
                                      [](int sum, std::uint64_t word) { return sum + std::popcount(word); });
  return std::min(allowed, quota_cores().value_or(kMostProcessors));
}

}  // namespace footwall
