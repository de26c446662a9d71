// A volume's info as the texts that stand in the file's attributes: each is one JSON value.
#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "storage/volume/volume_info.h"

namespace footwall::volume {

inline constexpr std::string_view kFormatName = "footwall volume";
inline constexpr int kFormatVersion = 1;

using Description = std::map<std::string, std::string>;  // attribute name to JSON

// All of info but what the datasets themselves say (dims, chunk, bytes). Throws kInvalid if the provenance is
// no JSON or the null value is infinite.
Description describe(const VolumeInfo& info);

// The names of the attributes that a file must have.
const std::vector<std::string>& description_names();

// The inverse; path only for messages. Throws kFormat for anything that is missing, of the wrong kind or out
// of range, kUnsupported for a newer version.
VolumeInfo info_from(const Description& description, const std::filesystem::path& path);

}  // namespace footwall::volume
