// What kind of file system a project lies on: it decides about journal, lock and immutability.
#pragma once
#include <filesystem>

#include "storage/project/project.h"

namespace footwall::project::detail {

// Of the folder `path` lies in. Network: NFS, SMB, Lustre, GPFS and the like, and everything behind FUSE or
// 9p, which cannot promise the shared memory that a write-ahead log needs. Read-only: mounted so, or no
// permission to write.
FileSystem file_system_of(const std::filesystem::path& path);

}  // namespace footwall::project::detail
