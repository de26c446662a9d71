#include "storage/project/detail/names.h"

#include <fmt/format.h>

#include "storage/base/error.h"

namespace footwall::project::detail {
namespace {

// The length of the well-formed UTF-8 character at the front (RFC 3629: no surrogates, no overlong forms), 0
// if none.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(text[at]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  for (std::size_t at = 1; at < length; ++at) {
    if ((byte(at) & 0xC0) != 0x80) return 0;
  }
  const bool overlong = (first == 0xE0 && byte(1) < 0xA0) || (first == 0xF0 && byte(1) < 0x90);
  const bool beyond = (first == 0xED && byte(1) > 0x9F) || (first == 0xF4 && byte(1) > 0x8F);
  return overlong || beyond ? 0 : length;
}

bool clean(std::string_view text, bool lines) {
  while (!text.empty()) {
    const auto first = static_cast<unsigned char>(text.front());
    if ((first < 0x20 && !(lines && (first == '\n' || first == '\t'))) || first == 0x7F) return false;
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

}  // namespace

void check_name(std::string_view what, const std::string& name) {
  if (name.empty()) throw Error(ErrorCode::kInvalid, fmt::format("a {} needs a name", what));
  if (name.size() > 200)
    throw Error(ErrorCode::kInvalid, fmt::format("a {}'s name has 200 bytes at most", what));
  if (!clean(name, false) || name.front() == ' ' || name.back() == ' ') {
    throw Error(ErrorCode::kInvalid, fmt::format("a {}'s name must be plain UTF-8 text", what),
                "no control characters, no blanks at its ends");
  }
}

void check_text(std::string_view what, const std::string& text) {
  if (text.size() > 100'000 || !clean(text, true)) {
    throw Error(ErrorCode::kInvalid, fmt::format("{} must be UTF-8 text of 100,000 bytes at most", what));
  }
}

std::string listed(const std::vector<std::string>& names) {
  if (names.empty()) return "none";
  std::string all;
  for (std::size_t at = 0; at < names.size() && at < 10; ++at) {
    all += fmt::format("{}'{}'", at == 0 ? "" : ", ", names[at]);
  }
  if (names.size() > 10) all += fmt::format(" and {} more", names.size() - 10);
  return all;
}

}  // namespace footwall::project::detail
