#include "storage/base/text.h"

#include <fmt/format.h>
#include <algorithm>
#include <system_error>

#include <charconv>
#include <cmath>

namespace footwall::text {
namespace {

constexpr std::string_view kBlank = " \t\r\n\v\f";

template <class Number>
std::optional<Number> parsed(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  Number value{};
  const char* end = word.data() + word.size();
  const auto [stop, failure] = std::from_chars(word.data(), end, value);
  if (failure != std::errc{} || stop != end || word.empty()) return std::nullopt;
  return value;
}

}  // namespace

std::string_view trimmed(std::string_view line) {
  const auto first = line.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return line.substr(first, line.find_last_not_of(kBlank) - first + 1);
}

std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> found;
  std::size_t at = 0;
  while ((at = line.find_first_not_of(kBlank, at)) != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(kBlank, at), line.size());
    found.push_back(line.substr(at, end - at));
    at = end;
  }
  return found;
}

std::vector<std::string_view> split(std::string_view line, char separator) {
  std::vector<std::string_view> found;
  std::size_t from = 0;
  while (true) {
    const std::size_t at = line.find(separator, from);
    found.push_back(trimmed(line.substr(from, at == std::string_view::npos ? at : at - from)));
    if (at == std::string_view::npos) return found;
    from = at + 1;
  }
}

std::optional<double> number(std::string_view word) {
  return parsed<double>(word);
}

std::optional<std::int64_t> integer(std::string_view word) {
  return parsed<std::int64_t>(word);
}

std::string shortest(double value) {
  if (std::isnan(value)) return {};
  return fmt::format("{}", value);
}

}  // namespace footwall::text
