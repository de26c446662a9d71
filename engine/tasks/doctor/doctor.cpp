#include "engine/tasks/doctor/doctor.h"

#include <fmt/format.h>

#include <optional>

#include "engine/session/private_folder.h"
#include "engine/tasks/doctor/engine_check.h"
#include "engine/tasks/doctor/folder.h"
#include "engine/tasks/doctor/machine.h"
#include "engine/tasks/doctor/opengl.h"
#include "engine/tasks/doctor/recommendation.h"
#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

// For progress only.
constexpr int kMachineRows = 13;
constexpr int kFolderRows = 12;

}  // namespace

std::vector<Finding> check_machine(const std::filesystem::path& folder, const session::LaunchOptions& launch,
                                   const JobContext& job) {
  Checkup checkup(job, kMachineRows);
  checkup.run("cores", check_cores);
  checkup.run("memory", check_memory);
  std::optional<session::PrivateFolder> place;
  if (checkup.run("temporary folder", [&] {
        const Finding finding = check_temporary_folder();
        place.emplace(session::temporary_home());
        return finding;
      })) {
    const auto facts = check_engine_rows(checkup, launch, place->path());
    if (facts && facts->rates)
      checkup.run("ranks and threads", [&] { return recommend_shape(*facts->rates); });
  }
  checkup.run("shared memory", [] { return check_shared_memory(); });
  checkup.run("disk space", [&] { return check_space(folder); });
  checkup.run("disk speed", [&] {
    try {
      const session::PrivateFolder here(folder);
      return check_speed(here.path(), job);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::kIo) throw;
      return warning(error.message(), "this folder cannot be written: change to one where you want to work");
    }
  });
  checkup.run("SQLite", check_sqlite);
  checkup.run("text", check_text);
  checkup.run("OpenGL", check_opengl);
  return std::move(checkup).findings();
}

std::vector<Finding> check_folder(const std::filesystem::path& folder, const session::LaunchOptions& launch,
                                  const JobContext& job) {
  Checkup checkup(job, kFolderRows);
  std::optional<session::PrivateFolder> place;
  const bool usable = checkup.run("file system", [&] {
    std::error_code trouble;
    if (!std::filesystem::is_directory(folder, trouble)) {
      if (std::filesystem::exists(folder, trouble))
        return failed(fmt::format("{} is no folder", folder.string()), "name the folder that it lies in");
      return failed(fmt::format("there is no folder {}", folder.string()),
                    "create it, or choose another one");
    }
    return check_file_system(folder);
  });
  if (!usable) return std::move(checkup).findings();
  checkup.run("space", [&] { return check_space(folder); });
  const bool writable = checkup.run("permissions", [&] {
    place.emplace(folder);
    return ok("files and folders can be made");
  });
  if (!writable) return std::move(checkup).findings();
  const std::filesystem::path& here = place->path();
  checkup.run("names", [&] { return check_names(here); });
  checkup.run("locks", [&] { return check_locks(here); });
  checkup.run("renaming", [&] { return check_rename(here); });
  checkup.run("flushing", [&] { return check_flush(here); });
  checkup.run("project", [&] { return check_project(here); });
  check_engine_rows(checkup, launch, here);
  checkup.run("speed", [&] { return check_speed(here, job); });
  return std::move(checkup).findings();
}

}  // namespace footwall::tasks
