// The last entry of an archive that pack_project makes: what is in it, so that a cut or altered one is told.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace footwall::tasks::detail {

struct PackList {
  struct File {
    std::string name;  // of the entry
    std::int64_t bytes = 0;
    std::uint64_t hash = 0;  // hash64 of the bytes
    friend bool operator==(const File&, const File&) = default;
  };
  std::string project;               // the name of its entry
  std::vector<File> files;           // in the archive's order, this list itself left out
  std::vector<std::string> volumes;  // by name
  std::vector<std::string> missing;  // volumes that were left out, by name
};

inline constexpr std::size_t kLongestList = std::size_t{64} << 20;

std::string volumes_folder_of(const std::string& project);  // NAME.volumes
std::string list_name_of(const std::string& project);       // NAME.pack.json

std::string to_json(const PackList& list);
// Throws kFormat for anything that to_json does not write, kUnsupported for a newer version.
PackList pack_list_from(const std::string& json);

}  // namespace footwall::tasks::detail
