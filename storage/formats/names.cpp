#include "storage/formats/names.h"

#include "storage/formats/detail/utf8.h"

namespace footwall::formats {

std::string clean_name(std::string_view bytes, std::size_t longest) {
  const std::string text = detail::as_utf8(bytes);
  std::string name;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const auto c = static_cast<unsigned char>(text[at]);
    // U+0080 to U+009F are control characters too, of two bytes.
    const bool wide_control =
        c == 0xC2 && at + 1 < text.size() && static_cast<unsigned char>(text[at + 1]) < 0xA0;
    if (wide_control) ++at;
    if (c <= 0x20 || c == 0x7F || wide_control) {
      if (!name.empty() && name.back() != ' ') name.push_back(' ');
    } else {
      name.push_back(text[at]);
    }
  }
  if (name.size() > longest) {
    std::size_t kept = longest;
    while (kept > 0 && (static_cast<unsigned char>(name[kept]) & 0xC0) == 0x80) --kept;
    name.resize(kept);
  }
  while (name.ends_with(' ')) name.pop_back();
  return name;
}

}  // namespace footwall::formats
