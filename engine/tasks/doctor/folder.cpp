#include "engine/tasks/doctor/folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <vector>

#include "engine/tasks/doctor/speed.h"
#include "storage/base/error.h"
#include "storage/base/partial_file.h"
#include "storage/project/file_system.h"
#include "storage/project/project.h"

namespace footwall::tasks {
namespace {

constexpr std::int64_t kMiB = std::int64_t{1} << 20;
constexpr std::int64_t kGiB = std::int64_t{1} << 30;

std::int64_t free_bytes(const std::filesystem::path& folder) {
  struct statvfs space {};
  if (::statvfs(folder.c_str(), &space) != 0) throw io_error("look at", folder.string(), errno);
  return static_cast<std::int64_t>(space.f_bavail) * static_cast<std::int64_t>(space.f_frsize);
}

// Asked of the system first; where it does not know (32 bits is its answer for any file system that it has
// not heard of) a file of 5 GiB without bytes in it is tried, if there is much more room than that.
bool holds_large_files(const std::filesystem::path& place) {
  if (::pathconf(place.c_str(), _PC_FILESIZEBITS) > 33 || free_bytes(place) < 20 * kGiB) return true;
  const auto path = place / "large";
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (file < 0) throw io_error("write", path.string(), errno);
  const bool held = ::ftruncate(file, 5 * kGiB) == 0;
  ::close(file);
  ::unlink(path.c_str());
  return held;
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Finding check_file_system(const std::filesystem::path& folder) {
  const auto facts = project::file_system_at(folder);
  if (facts.kind == project::FileSystem::kReadOnly || facts.mounted_read_only) {
    return failed(
        fmt::format("{}, mounted read-only: projects open here for reading, and nothing can be made",
                    facts.type),
        "choose another folder to work in");
  }
  if (facts.kind == project::FileSystem::kNetwork) {
    return ok(fmt::format(
        "{}, a network file system: a project is kept by a lease, without a write-ahead log", facts.type));
  }
  if (facts.in_memory) {
    return warning(fmt::format("{}, in this machine's memory", facts.type),
                   "what lies here is gone with the next start: keep projects elsewhere");
  }
  return ok(fmt::format("{}, local", facts.type));
}

Finding check_space(const std::filesystem::path& folder) {
  const std::int64_t bytes = free_bytes(folder);
  const std::string what =
      fmt::format("{:.1f} GiB free", static_cast<double>(bytes) / static_cast<double>(kGiB));
  if (bytes < 64 * kMiB) return failed(what, "make room: not even a small project fits");
  if (bytes < 10 * kGiB)
    return warning(what, "a volume takes 4 bytes a sample: 1000 x 1000 x 1000 are 3.7 GiB");
  return ok(what);
}

Finding check_names(const std::filesystem::path& place) {
  // a-umlaut, e with an accent of its own (which some systems join), a letter of four bytes
  const std::string name = "st\xC3\xB6rung e\xCC\x81 \xF0\x9F\x9C\xA8.h5";
  std::ofstream(place / name) << "x";
  bool kept = false;
  for (const auto& entry : std::filesystem::directory_iterator(place))
    kept |= entry.path().filename() == name;
  std::filesystem::remove(place / name);
  if (!kept) {
    return warning("names with letters beyond ASCII do not come back as they were given",
                   "use plain letters for projects and volumes here");
  }
  if (!holds_large_files(place)) {
    return failed("a file cannot have more than 4 GiB",
                  "choose a folder on another file system, or raise the limit (ulimit -f)");
  }
  return ok("UTF-8, and files beyond 4 GiB");
}

Finding check_rename(const std::filesystem::path& place) {
  const auto from = place / "new";
  const auto to = place / "old";
  std::ofstream(to) << "old";
  const int reader = ::open(to.c_str(), O_RDONLY | O_CLOEXEC);
  std::ofstream(from) << "new";
  const bool renamed = ::rename(from.c_str(), to.c_str()) == 0;
  const int reason = errno;
  char text[4] = {};
  const bool still_read = reader >= 0 && ::read(reader, text, 3) == 3 && std::string(text) == "old";
  if (reader >= 0) ::close(reader);
  if (!renamed) throw io_error("rename a file over another in", place.string(), reason);
  const bool replaced = read_whole_file(to, 16) == "new" && !std::filesystem::exists(from);
  std::filesystem::remove(to);
  if (!replaced) return failed("a file renamed over another did not take its place", "keep no projects here");
  if (!still_read) {
    return warning("who reads a file loses it when it is replaced",
                   "close what others read before you write it anew");
  }
  return ok("a file takes another's place at once");
}

Finding check_flush(const std::filesystem::path& place) {
  std::vector<double> times;
  for (int n = 0; n < 5; ++n) {
    const auto start = std::chrono::steady_clock::now();
    write_whole_file(place / "flushed", std::string(4096, 'x'));  // with the flush of file and folder
    times.push_back(milliseconds_since(start));
  }
  std::filesystem::remove(place / "flushed");
  return ok(fmt::format("a small file is on the disk after {:.1f} ms", median(times)));
}

Finding check_project(const std::filesystem::path& place) {
  const auto path = place / "trial.footwall";
  std::vector<double> times;
  {
    project::Project writer = project::Project::create(path, {});
    for (int n = 0; n < 9; ++n) {
      const auto start = std::chrono::steady_clock::now();
      writer.edit("add", [&](project::Interpretation& it) { it.add_fault(fmt::format("fault {}", n)); });
      times.push_back(milliseconds_since(start));
    }
    const project::Project reader = project::Project::open(path, project::OpenMode::kRead);
    if (reader.faults().size() != times.size())
      return failed("a reader does not see what was written", "keep no projects here");
    bool refused = false;
    try {
      project::Project::open(path, project::OpenMode::kWrite);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::kHeld) throw;
      refused = true;
    }
    if (!refused)
      return failed("a project can be written by two at once", "let only one program write here at a time");
    writer.close();
  }
  if (!project::Project::open(path, project::OpenMode::kWrite).check().ok())
    return failed("a project was damaged by being written", "keep no projects here");
  const std::string what = fmt::format(
      "made, edited, read along, closed; a second writer is refused; an edit takes {:.1f} ms", median(times));
  if (median(times) > 100) return warning(what, "edits will be felt: a local disk is quicker");
  return ok(what);
}

Finding check_speed(const std::filesystem::path& place, const JobContext& job) {
  const std::int64_t bytes = bytes_to_measure(free_bytes(place));
  if (bytes == 0) return warning("not measured: there is too little space", "make room");
  const Speed speed = measure_speed(place, bytes, job);
  const std::string what = fmt::format("written at {:.0f} MB/s, read at {:.0f} MB/s ({} MiB)",
                                       speed.write_mb_s, speed.read_mb_s, speed.bytes / kMiB);
  if (std::min(speed.write_mb_s, speed.read_mb_s) < 50)
    return warning(what, "large volumes will be slow here");
  return ok(what);
}

}  // namespace footwall::tasks
