#include "engine/session/private_folder.h"

#include <signal.h>
#include <unistd.h>

#include <cerrno>

#include "storage/base/error.h"
#include "storage/base/text.h"

namespace footwall::session {
namespace {

// With the host's name, because hosts may share the temporary folder, and a process number means nothing
// elsewhere.
std::string prefix() {
  char host[256] = "";
  if (gethostname(host, sizeof host - 1) != 0) throw io_error("ask for the name of", "this host", errno);
  return "footwall-" + std::to_string(geteuid()) + "-" + host + "-";
}

void remove_abandoned(const std::filesystem::path& home) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(home, ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix())) continue;
    const std::string rest = name.substr(prefix().size());
    const auto process = text::integer(rest.substr(0, rest.find('-')));
    if (!process || *process < 1 || kill(static_cast<pid_t>(*process), 0) == 0 || errno != ESRCH) continue;
    std::filesystem::remove_all(entry.path(), ignored);
  }
}

}  // namespace

std::filesystem::path home_in_memory() {
  std::filesystem::path memory = "/dev/shm";
  return access(memory.c_str(), W_OK | X_OK) == 0 ? memory : temporary_home();
}

std::filesystem::path temporary_home() {
  std::error_code failure;
  std::filesystem::path home = std::filesystem::temp_directory_path(failure);
  if (!failure) return home;
  throw Error(ErrorCode::kIo, "there is no folder for temporary files: " + failure.message(),
              "set TMPDIR to a folder that may be written");
}

PrivateFolder::PrivateFolder(const std::filesystem::path& home) {
  remove_abandoned(home);
  std::string name = (home / (prefix() + std::to_string(getpid()) + "-XXXXXX")).string();
  if (mkdtemp(name.data()) == nullptr) throw io_error("make the folder", name, errno);
  path_ = name;
}

PrivateFolder::~PrivateFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace footwall::session
