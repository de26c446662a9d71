#include "engine/tasks/doctor/machine.h"

#include <fmt/format.h>
#include <langinfo.h>
#include <locale.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <thread>

#include "engine/session/launch.h"
#include "engine/session/private_folder.h"
#include "storage/base/error.h"
#include "storage/base/usable_memory.h"
#include "storage/project/file_system.h"
#include "storage/project/sqlite_features.h"

namespace footwall::tasks {
namespace {

constexpr std::int64_t kMiB = std::int64_t{1} << 20;
constexpr std::int64_t kGiB = std::int64_t{1} << 30;

std::string in_gib(std::int64_t bytes) {
  return fmt::format("{:.1f} GiB", static_cast<double>(bytes) / static_cast<double>(kGiB));
}

std::int64_t free_bytes(const struct statvfs& space) {
  return static_cast<std::int64_t>(space.f_bavail) * static_cast<std::int64_t>(space.f_frsize);
}

}  // namespace

Finding check_cores() {
  const int usable = session::usable_cores();
  const auto there = static_cast<int>(std::thread::hardware_concurrency());
  return ok(usable < there ? fmt::format("{} usable of the machine's {}", usable, there)
                           : fmt::format("{} usable", usable));
}

Finding check_memory() {
  const UsableMemory memory = usable_memory();
  const std::string what =
      fmt::format("{} free for use, of {}", in_gib(memory.bytes), in_gib(memory.machine));
  if (memory.bytes < 2 * kGiB)
    return warning(what,
                   "close other programs, or ask for more (a container's or a job's limit may be in force)");
  return ok(what);
}

Finding check_shared_memory(const std::filesystem::path& place) {
  struct statvfs space {};
  if (::statvfs(place.c_str(), &space) != 0 || ::access(place.c_str(), W_OK | X_OK) != 0) {
    return warning(
        fmt::format("{} cannot be used: ranks talk through files instead, which is slower", place.string()),
        "mount a tmpfs there");
  }
  const std::string what = fmt::format("{}: {} MiB free", place.string(), free_bytes(space) / kMiB);
  // A rank takes some MiB for its neighbours on the same node.
  if (free_bytes(space) < 256 * kMiB)
    return warning(what, "a container gets more by --shm-size=1g; else remove what was left there");
  return ok(what);
}

Finding check_temporary_folder() {
  const std::filesystem::path home = session::temporary_home();
  { const session::PrivateFolder trial(home); }
  struct stat facts {};
  struct statvfs space {};
  if (::stat(home.c_str(), &facts) != 0 || ::statvfs(home.c_str(), &space) != 0)
    throw io_error("look at", home.string(), errno);
  const auto system = project::file_system_at(home);
  std::string what = fmt::format("{}: {}, {} free", home.string(), system.type, in_gib(free_bytes(space)));
  if ((space.f_flag & ST_NOEXEC) != 0) what += ", mounted noexec (which nothing here minds)";
  if ((facts.st_mode & S_IWOTH) != 0 && (facts.st_mode & S_ISVTX) == 0) {
    return warning(what + "; everybody may remove what is in it",
                   fmt::format("chmod +t {}, or set TMPDIR to a folder of your own", home.string()));
  }
  if (system.kind == project::FileSystem::kNetwork)
    return warning(what, "set TMPDIR to a folder on a disk of this machine: jobs keep small files there");
  if (free_bytes(space) < kGiB) return warning(what, "make room there, or set TMPDIR to another folder");
  return ok(what);
}

Finding check_text() {
  const locale_t chosen = ::newlocale(LC_CTYPE_MASK, "", nullptr);
  if (chosen == nullptr) {
    return warning("the language set in LANG or LC_ALL is not installed on this machine",
                   "export LC_ALL=C.UTF-8");
  }
  const std::string encoding = ::nl_langinfo_l(CODESET, chosen);
  ::freelocale(chosen);
  if (encoding == "UTF-8") return ok("UTF-8");
  return warning(
      fmt::format("the terminal's encoding is {}: names may be shown wrongly (files are right)", encoding),
      "export LC_ALL=C.UTF-8");
}

Finding check_sqlite() {
  const project::SqliteFeatures features = project::sqlite_features();
  const std::string what = "SQLite " + features.running;
  if (!features.missing.empty()) {
    return failed(fmt::format("{} lacks {}", what, fmt::join(features.missing, ", ")),
                  "use the SQLite of the system, or one built with these");
  }
  return ok(what + ", with all that a project needs");
}

}  // namespace footwall::tasks
