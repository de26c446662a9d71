// Folders that are one user's alone.
#pragma once
#include <filesystem>

namespace footwall::service {

// Makes the folder, mode 0700, where it is not there: then true. Throws Error kUsage where others than this
// user can read or write it, or it belongs to somebody else; kIo.
bool require_private_folder(const std::filesystem::path& folder);

}  // namespace footwall::service
