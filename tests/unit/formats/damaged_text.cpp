#include "damaged_text.h"

namespace footwall::formats {

std::string damaged(const std::string& good, std::mt19937_64& random) {
  constexpr std::string_view kBytes{"\0\n\r\t -+.:,;{}@!#>9E1\"'\xC3\xFF", 25};
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  std::string text = good;
  for (std::size_t change = 0, changes = 1 + below(6); change < changes; ++change) {
    const std::size_t at = below(text.size());
    const std::size_t length = below(40);
    switch (below(6)) {
      case 0:
        text.resize(at);
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, good.substr(below(good.size()), length));
        break;
      case 3:
        text.insert(at, 1, kBytes[below(kBytes.size())]);
        break;
      case 4:
        text.insert(at, std::string(below(30), '9'));
        break;
      default:
        if (!text.empty()) text[at] = kBytes[below(kBytes.size())];
    }
  }
  return text;
}

}  // namespace footwall::formats
