// Key words of text files are compared without regard to case.
#pragma once
#include <string>
#include <string_view>

namespace footwall::formats::detail {

// A to Z made small, whatever the locale; all other bytes stay.
inline std::string lower(std::string_view text) {
  std::string out(text);
  for (char& letter : out) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  return out;
}

}  // namespace footwall::formats::detail
