#include "storage/project/detail/file_system.h"

#include <sys/statfs.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>

#include "storage/base/error.h"

namespace footwall::project::detail {
namespace {

// From statfs(2) and linux/magic.h; the cluster file systems from their own headers.
constexpr std::uint32_t kNetworkTypes[] = {
    0x00006969,  // NFS
    0x0000517B,  // SMB
    0xFF534D42,  // CIFS
    0xFE534D42,  // SMB2
    0x0BD00BD0,  // Lustre
    0x47504653,  // GPFS
    0x19830326,  // BeeGFS
    0x00C36400,  // Ceph
    0x20030528,  // OrangeFS
    0xAAD7AAEA,  // PanFS
    0x5346414F,  // AFS
    0x6B414653,  // kAFS
    0x73757245,  // Coda
    0x01021997,  // 9p
    0x65735546,  // FUSE: sshfs and others
    0x786F4256,  // VirtualBox shared folder
};

}  // namespace

FileSystem file_system_of(const std::filesystem::path& path) {
  const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
  struct statfs kind {};
  struct statvfs flags {};
  if (::statfs(folder.c_str(), &kind) != 0 || ::statvfs(folder.c_str(), &flags) != 0) {
    throw io_error("look at", folder, errno);
  }
  if ((flags.f_flag & ST_RDONLY) != 0 || ::access(folder.c_str(), W_OK) != 0) return FileSystem::kReadOnly;
  const auto type = static_cast<std::uint32_t>(kind.f_type);
  for (const std::uint32_t network : kNetworkTypes) {
    if (type == network) return FileSystem::kNetwork;
  }
  return FileSystem::kLocal;
}

}  // namespace footwall::project::detail
