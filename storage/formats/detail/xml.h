// Text inside XML.
#pragma once
#include <string>

namespace footwall::formats::detail {

// For element content and attributes in double quotes; control characters, which XML 1.0 has no room for,
// become blanks.
std::string xml_escaped(const std::string& text);

}  // namespace footwall::formats::detail
