// A text as a cell of CSV (RFC 4180).
#pragma once
#include <string>

namespace footwall::formats::detail {

// In quotation marks where a comma, a quotation mark or a line end stands in it.
inline std::string csv_quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char letter : text) {
    if (letter == '"') out.push_back('"');
    out.push_back(letter);
  }
  return out + '"';
}

}  // namespace footwall::formats::detail
