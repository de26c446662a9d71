#include "storage/formats/segy/text_header.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <string_view>
#include <utility>

namespace footwall::formats::segy {
namespace {

// Code page 037; characters outside printable ASCII are blank.
constexpr std::string_view kFromEbcdic =
    "                "
    "                "
    "                "
    "                "
    "           .<(+|"
    "&         !$*); "
    "-/         ,%_>\?"
    "         `:#@'=\""
    " abcdefghi      "
    " jklmnopqr      "
    " ~stuvwxyz      "
    "^         []    "
    "{ABCDEFGHI      "
    "}JKLMNOPQR      "
    "\\ STUVWXYZ      "
    "0123456789      ";
static_assert(kFromEbcdic.size() == 256);

// How much the bytes look like text: letters, digits and above all blanks; control characters count against
// it.
std::int64_t score(std::span<const std::byte> text, bool ebcdic) {
  std::int64_t sum = 0;
  for (const std::byte character : text) {
    const auto code = std::to_integer<unsigned char>(character);
    const unsigned char blank = ebcdic ? 0x40 : 0x20;
    if (code == blank) {
      sum += 2;
    } else if (std::isalnum(static_cast<unsigned char>(decoded(character, ebcdic)))) {
      sum += 1;
    } else if (decoded(character, ebcdic) == ' ') {
      sum -= 1;
    }
  }
  return sum;
}

}  // namespace

bool is_ebcdic(std::span<const std::byte> text) {
  return score(text, true) > score(text, false);
}

char decoded(std::byte character, bool ebcdic) {
  const auto code = std::to_integer<unsigned char>(character);
  if (ebcdic) return kFromEbcdic[code];
  return code >= 0x20 && code < 0x7F ? static_cast<char>(code) : ' ';
}

std::vector<std::string> text_lines(std::span<const std::byte> text, bool ebcdic) {
  constexpr std::size_t kColumns = 80;
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size(); at += kColumns) {
    std::string line;
    for (const std::byte character : text.subspan(at, std::min(kColumns, text.size() - at))) {
      line.push_back(decoded(character, ebcdic));
    }
    line.erase(line.find_last_not_of(' ') + 1);
    lines.push_back(std::move(line));
  }
  return lines;
}

bool is_end_stanza(std::span<const std::byte> text) {
  constexpr std::string_view kEnd = "((seg:endtext))";
  const bool ebcdic = is_ebcdic(text);
  std::string folded;
  for (const std::byte character : text) {
    const char letter = decoded(character, ebcdic);
    if (letter == ' ') continue;
    folded.push_back(static_cast<char>(std::tolower(static_cast<unsigned char>(letter))));
    if (folded.size() == kEnd.size()) break;
  }
  return folded == kEnd;
}

}  // namespace footwall::formats::segy
