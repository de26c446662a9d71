#include "storage/formats/units.h"

#include <fmt/format.h>
#include <cctype>
#include <string>

#include "storage/base/error.h"

namespace footwall::formats {
namespace {

struct Spelling {
  std::string_view word, unit;
};
constexpr Spelling kSpellings[] = {
    {"m", "m"},      {"meter", "m"}, {"meters", "m"},       {"metre", "m"},
    {"metres", "m"}, {"ft", "ft"},   {"feet", "ft"},        {"foot", "ft"},
    {"ms", "ms"},    {"msec", "ms"}, {"millisecond", "ms"}, {"milliseconds", "ms"},
    {"s", "s"},      {"sec", "s"},   {"second", "s"},       {"seconds", "s"},
};

bool is_time(std::string_view unit) {
  return unit == "ms" || unit == "s";
}

}  // namespace

std::string_view unit_from(std::string_view word) {
  std::string plain;
  for (const char letter : word) {
    if (letter == '"' || letter == '\'' || letter == '[' || letter == ']') continue;
    plain.push_back(static_cast<char>(std::tolower(static_cast<unsigned char>(letter))));
  }
  for (const Spelling& spelling : kSpellings) {
    if (spelling.word == plain) return spelling.unit;
  }
  return {};
}

double unit_factor(std::string_view from, std::string_view to) {
  for (const std::string_view unit : {from, to}) {
    if (unit_from(unit) != unit || unit.empty()) {
      throw Error(ErrorCode::kInvalid, fmt::format("'{}' is no unit of z", unit), "there is ms, s, m, ft");
    }
  }
  if (is_time(from) != is_time(to)) {
    throw Error(ErrorCode::kInvalid,
                fmt::format("z in {} cannot become z in {}: one is a time, the other a length", from, to),
                "convert between time and depth with a velocity model first");
  }
  if (from == to) return 1;
  if (from == "ms") return 1e-3;
  if (from == "s") return 1e3;
  return from == "ft" ? 0.3048 : 1 / 0.3048;
}

}  // namespace footwall::formats
