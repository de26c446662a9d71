// A folder with volume files, which are found by their checksum.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace footwall::service {

class VolumeFolder {
 public:
  // May be empty: then nothing is found.
  explicit VolumeFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // The first file NAME.h5, by name, with this checksum (16 hex digits). Each file is looked into once, and
  // again after it changed; files that are no volumes are passed over. Throws Error kIo where the folder
  // cannot be read.
  std::optional<std::filesystem::path> find(const std::string& checksum);
  const std::filesystem::path& path() const { return folder_; }

 private:
  struct Seen {
    std::uintmax_t size = 0;
    std::filesystem::file_time_type time;
    std::string checksum;  // empty: no volume
  };
  const std::string& checksum_of(const std::filesystem::path& file);

  std::filesystem::path folder_;
  std::map<std::filesystem::path, Seen> seen_;
};

}  // namespace footwall::service
