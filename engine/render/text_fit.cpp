#include "engine/render/text_fit.h"

#include <algorithm>

namespace footwall::render {
namespace {

constexpr std::size_t kLongestLooked = 1024;  // bytes; no picture is wide enough for more

// The longest beginning of at most `bytes` that does not cut a letter.
std::string_view beginning(std::string_view text, std::size_t bytes) {
  if (bytes >= text.size()) return text;
  while (bytes > 0 && (static_cast<unsigned char>(text[bytes]) & 0xc0U) == 0x80U) --bytes;
  return text.substr(0, bytes);
}

}  // namespace

std::string fitted(Typeface& typeface, std::string_view text, double size, bool bold, double room) {
  const bool whole = text.size() <= kLongestLooked;
  if (whole && typeface.width(text, size, bold) <= room) return std::string(text);
  const auto shortened = [&](std::size_t bytes) {
    std::string_view kept = beginning(text, bytes);
    while (!kept.empty() && (kept.back() == ' ' || kept.back() == ',')) kept.remove_suffix(1);
    return std::string(kept) + "…";
  };
  std::size_t fits = 0;
  std::size_t too_long = std::min(text.size(), kLongestLooked) + 1;
  while (too_long - fits > 1) {
    const std::size_t bytes = (fits + too_long) / 2;
    (typeface.width(shortened(bytes), size, bold) <= room ? fits : too_long) = bytes;
  }
  return shortened(fits);
}

std::vector<std::string> wrapped(Typeface& typeface, std::string_view text, double size, double room,
                                 std::size_t most) {
  std::vector<std::string> lines;
  text = beginning(text, kLongestLooked);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view rest = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    std::string line;
    while (!rest.empty()) {
      const std::size_t space = std::min(rest.find(' '), rest.size());
      const std::string longer = (line.empty() ? "" : line + " ") + std::string(rest.substr(0, space));
      rest.remove_prefix(std::min(space + 1, rest.size()));
      if (line.empty() || typeface.width(longer, size) <= room) {
        line = longer;
        continue;
      }
      lines.push_back(line);
      line = longer.substr(line.size() + 1);
    }
    if (!line.empty()) lines.push_back(line);
  }
  if (lines.size() > most) {
    lines.resize(most);
    if (most > 0) lines.back() += " …";
  }
  for (std::string& line : lines) line = fitted(typeface, line, size, false, room);
  return lines;
}

}  // namespace footwall::render
