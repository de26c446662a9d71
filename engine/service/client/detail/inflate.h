// zlib streams of an engine.
#pragma once
#include <string>
#include <string_view>

namespace footwall::service {

// Appends what the one zlib stream in `packed` holds. Throws Error kEngine where it is none, is cut, or holds
// more than `most` bytes.
void inflate(std::string_view packed, std::size_t most, std::string& to);

}  // namespace footwall::service
