#include "engine/service/server/private_folder.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "storage/base/error.h"

namespace footwall::service {

bool require_private_folder(const std::filesystem::path& folder) {
  const std::string name = folder.string();
  const bool made = ::mkdir(name.c_str(), 0700) == 0;
  if (!made && errno != EEXIST) throw io_error("make the folder", name, errno);
  struct stat facts = {};
  if (::stat(name.c_str(), &facts) != 0) throw io_error("look at", name, errno);
  if (!S_ISDIR(facts.st_mode)) throw Error(ErrorCode::kUsage, fmt::format("{} is not a folder", name));
  if (facts.st_uid != ::geteuid() || (facts.st_mode & 077U) != 0) {
    throw Error(ErrorCode::kUsage, fmt::format("the folder {} is not yours alone", name),
                fmt::format("chmod 700 {}, or name another folder", name));
  }
  return made;
}

}  // namespace footwall::service
