// A project and its volumes as one archive NAME.footwall.tar, and back. The archive holds NAME.footwall (a
// copy of the database as of one moment, also while somebody writes), NAME.footwall.volumes/FILE for each
// volume, and last NAME.footwall.pack.json, which lists the files with sizes and hashes: an archive that was
// cut has none.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "storage/base/job_context.h"
#include "storage/project/project.h"

namespace footwall::tasks {

struct PackOptions {
  bool without_missing = false;  // pack although volumes are missing, without them
};

struct Packed {
  std::filesystem::path archive;
  std::int64_t bytes = 0;            // of the archive
  std::vector<std::string> volumes;  // in it, by name
  std::vector<std::string> missing;  // left out
};

// Reads the project only; every chunk of every volume is checked on the way. A volume that lies elsewhere
// comes into the volumes folder, under its own file name or a free one. Throws kNotFound for missing volumes,
// kCorrupt for a damaged one, kInvalid where `archive` exists, kIo. Cancelled or failed it leaves nothing.
Packed pack_project(const project::Project& project, const std::filesystem::path& archive,
                    const PackOptions& options, const JobContext& job);

struct Unpacked {
  std::filesystem::path project;
  std::vector<std::string> volumes;
  std::vector<std::string> missing;  // were left out when it was packed
};

// Unpacks below `folder` (which must exist) and checks every file against its hash, the project, and every
// chunk of every volume, before anything takes its name. Throws kInvalid where a file of these names exists;
// kFormat for an archive that pack_project did not make; kCorrupt for a damaged or cut one; kIo, also where
// the disk is too small. Cancelled or failed it leaves nothing.
Unpacked unpack_project(const std::filesystem::path& archive, const std::filesystem::path& folder,
                        const JobContext& job);

}  // namespace footwall::tasks
