// Files that are handed in as fault sticks and are something else, told from their content.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace footwall::formats {

struct OtherFile {
  std::string what;  // "a SEG-Y file"
  std::string use;   // what to do with it
};

// Nothing for what may be fault sticks. head: the first 64 KiB at least; size: of the whole file.
std::optional<OtherFile> recognise_other(std::string_view head, std::uint64_t size);

}  // namespace footwall::formats
