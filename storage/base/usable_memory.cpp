#include "storage/base/usable_memory.h"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

#include "storage/base/text.h"

namespace footwall {
namespace {

// A file of one number; nothing for "max", or where there is none.
std::optional<std::int64_t> number_in(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) return std::nullopt;
  return text::integer(text::trimmed(line));
}

// "MemAvailable:   123 kB"
std::int64_t meminfo(const std::filesystem::path& root, std::string_view key) {
  std::ifstream file(root / "proc/meminfo");
  for (std::string line; std::getline(file, line);) {
    const auto words = text::words(line);
    if (words.size() >= 2 && words[0] == key) return text::integer(words[1]).value_or(0) * 1024;
  }
  return 0;
}

// What is left in one control group; what only caches files is given back when it is wanted.
std::optional<std::int64_t> left_in(const std::filesystem::path& group, const char* limit, const char* used) {
  const auto most = number_in(group / limit);
  if (!most) return std::nullopt;
  std::int64_t cache = 0;
  std::ifstream file(group / "memory.stat");
  for (std::string line; std::getline(file, line);) {
    const auto words = text::words(line);
    if (words.size() == 2 && (words[0] == "inactive_file" || words[0] == "total_inactive_file"))
      cache = text::integer(words[1]).value_or(0);
  }
  return std::max<std::int64_t>(0, *most - number_in(group / used).value_or(0) + cache);
}

// The group and all that it is in; in a container the path may not be there, and the root stands for it.
std::int64_t least_left(std::filesystem::path home, const std::string& path, const char* limit,
                        const char* used) {
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  const auto look = [&](const std::filesystem::path& group) {
    if (const auto left = left_in(group, limit, used)) least = std::min(least, *left);
  };
  look(home);
  for (const auto& part : std::filesystem::path(path).relative_path()) {
    home /= part;
    look(home);
  }
  return least;
}

}  // namespace

UsableMemory usable_memory(const std::filesystem::path& root) {
  UsableMemory memory;
  memory.machine = meminfo(root, "MemTotal:");
  memory.bytes = meminfo(root, "MemAvailable:");
  // "0::/path" is version 2; "5:memory:/path" version 1.
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const auto parts = text::split(line, ':');
    if (parts.size() < 3) continue;
    const std::string path(parts[2]);
    if (parts[0] == "0" && parts[1].empty()) {
      memory.bytes =
          std::min(memory.bytes, least_left(root / "sys/fs/cgroup", path, "memory.max", "memory.current"));
    } else if (parts[1] == "memory") {
      memory.bytes = std::min(memory.bytes, least_left(root / "sys/fs/cgroup/memory", path,
                                                       "memory.limit_in_bytes", "memory.usage_in_bytes"));
    }
  }
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    memory.bytes = std::min(memory.bytes, static_cast<std::int64_t>(limit.rlim_cur));
  return memory;
}

}  // namespace footwall
