// Names from files of unknown encoding.
#pragma once
#include <string>
#include <string_view>

namespace footwall::formats::detail {

// Valid UTF-8 as it is; anything else is read as Latin-1, which every byte sequence is.
std::string as_utf8(std::string_view bytes);

}  // namespace footwall::formats::detail
