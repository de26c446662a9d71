#include "storage/formats/z_unit.h"

#include <fmt/format.h>
#include <array>
#include <string>

#include "storage/base/error.h"
#include "storage/base/text.h"
#include "storage/formats/detail/letters.h"
#include "storage/survey/units.h"

namespace footwall::formats {
namespace {

struct Unit {
  std::string_view name;
  bool is_time;
  double size;  // in milliseconds or metres
};
constexpr std::array<Unit, 4> kUnits{
    {{"ms", true, 1}, {"s", true, 1000}, {"m", false, 1}, {"ft", false, survey::kMetresPerFoot}}};

struct Spelling {
  std::string_view word;
  std::string_view unit;
};
constexpr std::array<Spelling, 20> kSpellings{
    {{"ms", "ms"}, {"msec", "ms"}, {"msecs", "ms"}, {"millisecond", "ms"}, {"milliseconds", "ms"},
     {"s", "s"},   {"sec", "s"},   {"secs", "s"},   {"second", "s"},       {"seconds", "s"},
     {"m", "m"},   {"meter", "m"}, {"meters", "m"}, {"metre", "m"},        {"metres", "m"},
     {"ft", "ft"}, {"feet", "ft"}, {"foot", "ft"},  {"mtr", "m"},          {"mtrs", "m"}}};

const Unit& unit_named(std::string_view name) {
  for (const Unit& unit : kUnits) {
    if (unit.name == name) return unit;
  }
  throw Error(ErrorCode::kUsage, fmt::format("'{}' is no unit of z", name), "units: ms, s, m, ft");
}

}  // namespace

std::optional<std::string_view> z_unit_from(std::string_view word) {
  const std::string lower = detail::lower(text::trimmed(word));
  for (const Spelling& spelling : kSpellings) {
    if (spelling.word == lower) return spelling.unit;
  }
  return std::nullopt;
}

double z_unit_factor(std::string_view from, std::string_view to) {
  const Unit& a = unit_named(from);
  const Unit& b = unit_named(to);
  if (a.is_time != b.is_time) {
    throw Error(ErrorCode::kUsage, fmt::format("z in {} cannot be turned into {}", from, to),
                "between time and depth only a velocity converts: name a unit of the survey's domain");
  }
  return a.size / b.size;
}

int z_decimals(std::string_view unit) {
  return unit == "s" ? 7 : 4;
}

}  // namespace footwall::formats
