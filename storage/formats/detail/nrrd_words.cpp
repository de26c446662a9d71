#include "storage/formats/detail/nrrd_words.h"

#include <algorithm>

#include "storage/base/text.h"
#include "storage/formats/detail/utf8.h"

namespace footwall::formats::nrrd {

std::optional<std::vector<double>> vector_from(std::string_view word) {
  if (word.size() < 3 || word.front() != '(' || word.back() != ')') return std::nullopt;
  std::vector<double> values;
  for (const std::string_view part : text::split(word.substr(1, word.size() - 2), ',')) {
    const auto value = text::number(part);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

std::vector<std::string_view> vector_words(std::string_view value) {
  std::vector<std::string_view> words;
  std::size_t at = 0;
  while ((at = value.find_first_not_of(" \t", at)) != std::string_view::npos) {
    std::size_t end = value[at] == '(' ? value.find(')', at) : value.find_first_of(" \t", at);
    if (value[at] == '(' && end != std::string_view::npos) ++end;
    if (end == std::string_view::npos) end = value.size();
    words.push_back(value.substr(at, end - at));
    at = end;
  }
  return words;
}

std::vector<std::string> quoted_words(std::string_view value) {
  std::vector<std::string> words;
  std::size_t at = 0;
  while ((at = value.find_first_not_of(" \t", at)) != std::string_view::npos) {
    const bool quoted = value[at] == '"';
    if (quoted) ++at;
    const std::size_t end = std::min(value.find_first_of(quoted ? "\"" : " \t", at), value.size());
    words.push_back(detail::as_utf8(value.substr(at, end - at)));
    at = end + (quoted && end < value.size() ? 1 : 0);
  }
  return words;
}

}  // namespace footwall::formats::nrrd
