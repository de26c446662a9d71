// What kind of file system a project lies on: it decides about journal, lock and immutability.
#pragma once
#include <filesystem>
#include <string>

#include "storage/project/project.h"

namespace footwall::project {

struct FileSystemFacts {
  FileSystem kind = FileSystem::kLocal;
  std::string type;        // e.g. "ext4", "nfs"; a hexadecimal number where we have no name for it
  bool in_memory = false;  // gone with the next start of the machine
  bool mounted_read_only = false;
};

// Of an existing folder. Network: NFS, SMB, Lustre, GPFS and the like, the file systems that several hosts
// have on one disk, and everything behind FUSE or 9p: none of them promises the shared memory that a
// write-ahead log needs. Read-only: a local one mounted so, that nobody writes; missing permissions are not
// meant. A network file system mounted read-only stays a network one, since others may write to it. Throws
// kIo.
FileSystemFacts file_system_at(const std::filesystem::path& folder);

}  // namespace footwall::project
