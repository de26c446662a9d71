#include "storage/project/file_system.h"

#include <fmt/format.h>
#include <sys/statfs.h>
#include <sys/statvfs.h>

#include <cerrno>

#include "storage/base/error.h"

namespace footwall::project {
namespace {

struct Type {
  std::uint32_t magic;
  const char* name;
};

// From statfs(2) and linux/magic.h; the cluster file systems from their own headers.
constexpr Type kNetworkTypes[] = {
    {0x00006969, "nfs"},      {0x0000517B, "smb"},   {0xFF534D42, "cifs"},   {0xFE534D42, "smb2"},
    {0x0BD00BD0, "lustre"},   {0x47504653, "gpfs"},  {0x19830326, "beegfs"}, {0x00C36400, "ceph"},
    {0x20030528, "orangefs"}, {0xAAD7AAEA, "panfs"}, {0x5346414F, "afs"},    {0x6B414653, "kafs"},
    {0x73757245, "coda"},     {0x01021997, "9p"},    {0x65735546, "fuse"},  // sshfs and others
    {0x786F4256, "vboxsf"},   {0x01161970, "gfs2"},                         // one disk, several hosts
    {0x7461636F, "ocfs2"},
};
constexpr Type kMemoryTypes[] = {{0x01021994, "tmpfs"}, {0x858458F6, "ramfs"}};
constexpr Type kLocalTypes[] = {
    {0x0000EF53, "ext4"}, {0x58465342, "xfs"},      {0x9123683E, "btrfs"},    {0x794C7630, "overlay"},
    {0x2FC12FC1, "zfs"},  {0xF2F52010, "f2fs"},     {0x00004D44, "vfat"},     {0x2011BAB0, "exfat"},
    {0x5346544E, "ntfs"}, {0x7366746E, "ntfs3"},    {0x73717368, "squashfs"}, {0x00009660, "iso9660"},
    {0x15013346, "udf"},  {0xCA451A4E, "bcachefs"},
};

template <std::size_t N>
const char* name_in(const Type (&types)[N], std::uint32_t magic) {
  for (const Type& type : types) {
    if (type.magic == magic) return type.name;
  }
  return nullptr;
}

}  // namespace

FileSystemFacts file_system_at(const std::filesystem::path& folder) {
  struct statfs kind {};
  struct statvfs flags {};
  if (::statfs(folder.c_str(), &kind) != 0 || ::statvfs(folder.c_str(), &flags) != 0) {
    throw io_error("look at", folder.string(), errno);
  }
  const auto magic = static_cast<std::uint32_t>(kind.f_type);
  FileSystemFacts facts;
  facts.mounted_read_only = (flags.f_flag & ST_RDONLY) != 0;
  if (const char* network = name_in(kNetworkTypes, magic)) {
    facts.kind = FileSystem::kNetwork;
    facts.type = network;
    return facts;
  }
  if (facts.mounted_read_only) facts.kind = FileSystem::kReadOnly;
  const char* memory = name_in(kMemoryTypes, magic);
  const char* local = name_in(kLocalTypes, magic);
  facts.in_memory = memory != nullptr;
  facts.type = memory != nullptr ? memory : local != nullptr ? local : fmt::format("type {:#x}", magic);
  return facts;
}

}  // namespace footwall::project
