#include "engine/service/server/requests/failure.h"

#include <algorithm>
#include <bit>

namespace footwall::service {
namespace {

constexpr std::size_t kMostText = 1024;

// Bytes of the character that begins here, 0 where none does. Overlong forms, surrogates and what lies beyond
// the last plane are none.
std::size_t character(std::string_view text) {
  const auto byte = [&](std::size_t n) { return static_cast<unsigned char>(text[n]); };
  if (byte(0) < 0x80) return 1;
  const auto length = static_cast<std::size_t>(std::countl_one(byte(0)));
  if (length < 2 || length > 4 || text.size() < length) return 0;
  std::uint32_t code = byte(0) & (0x7FU >> length);
  for (std::size_t n = 1; n < length; ++n) {
    if ((byte(n) & 0xC0U) != 0x80U) return 0;
    code = code << 6U | (byte(n) & 0x3FU);
  }
  constexpr std::uint32_t kSmallest[] = {0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  return code < kSmallest[length - 2] || surrogate || code > 0x10FFFF ? 0 : length;
}

}  // namespace

std::string utf8_of(std::string_view text, std::size_t most) {
  std::string out;
  out.reserve(std::min(text.size(), most));
  while (!text.empty()) {
    const std::size_t length = character(text);
    if (out.size() + std::max<std::size_t>(length, 1) > most) break;
    if (length == 0) {
      out += '?';
    } else {
      out += text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

v1::Failure failure_of(const Error& error) {
  v1::Failure failure;
  failure.set_code(std::string(name_of(error.code())));
  failure.set_message(utf8_of(error.message(), kMostText));
  failure.set_hint(utf8_of(error.hint(), kMostText));
  return failure;
}

}  // namespace footwall::service
