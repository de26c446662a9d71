#include "storage/formats/detail/xml.h"

namespace footwall::formats::detail {

std::string xml_escaped(const std::string& text) {
  std::string out;
  for (const char letter : text) {
    switch (letter) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out.push_back(static_cast<unsigned char>(letter) < 0x20 ? ' ' : letter);
    }
  }
  return out;
}

}  // namespace footwall::formats::detail
