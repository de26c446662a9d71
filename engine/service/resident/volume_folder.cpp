#include "engine/service/resident/volume_folder.h"

#include <algorithm>
#include <vector>

#include "storage/base/error.h"
#include "storage/base/hash.h"
#include "storage/volume/volume_reader.h"

namespace footwall::service {

const std::string& VolumeFolder::checksum_of(const std::filesystem::path& file) {
  std::error_code failure;
  const auto size = std::filesystem::file_size(file, failure);
  const auto time =
      failure ? std::filesystem::file_time_type() : std::filesystem::last_write_time(file, failure);
  const auto known = seen_.find(file);
  if (known != seen_.end() && !failure && known->second.size == size && known->second.time == time)
    return known->second.checksum;
  Seen seen{size, time, {}};
  try {
    seen.checksum = to_hex(volume::VolumeReader(file).info().checksum);
  } catch (const Error&) {
    // No volume, or a damaged one: whoever asks for it by its path is told.
  }
  return seen_.insert_or_assign(file, std::move(seen)).first->second.checksum;
}

std::optional<std::filesystem::path> VolumeFolder::find(const std::string& checksum) {
  if (folder_.empty() || checksum.empty()) return std::nullopt;
  std::error_code failure;
  std::filesystem::directory_iterator at(folder_, failure);
  std::vector<std::filesystem::path> files;
  for (; !failure && at != std::filesystem::directory_iterator(); at.increment(failure)) {
    if (at->path().extension() == ".h5") files.push_back(at->path());
  }
  if (failure) throw io_error("read the folder", folder_.string(), failure.value());
  std::sort(files.begin(), files.end());
  for (const std::filesystem::path& file : files) {
    if (checksum_of(file) == checksum) return file;
  }
  return std::nullopt;
}

}  // namespace footwall::service
