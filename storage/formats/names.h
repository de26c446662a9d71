// Names from files, as a project takes them.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace footwall::formats {

constexpr std::size_t kLongestName = 200;  // bytes

// Valid UTF-8 (anything else is read as Latin-1), control characters and runs of blanks as one blank, none at
// the ends, cut between characters to `longest` bytes. May be empty.
std::string clean_name(std::string_view bytes, std::size_t longest = kLongestName);

}  // namespace footwall::formats
