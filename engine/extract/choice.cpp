#include "engine/extract/choice.h"

#include <fmt/format.h>
#include <cmath>

#include "storage/base/error.h"
#include "storage/base/text.h"

namespace footwall::extract {

double Choice::number(std::size_t place, std::string_view what, double otherwise, double least,
                      double most) const {
  if (place >= parameters.size()) return otherwise;
  const auto value = text::number(parameters[place]);
  if (!value || !(*value >= least && *value <= most)) {
    throw Error(ErrorCode::kUsage, fmt::format("'{}' is no {} of '{}'", parameters[place], what, name),
                fmt::format("give a number from {} to {}", least, most));
  }
  return *value;
}

std::int64_t Choice::whole(std::size_t place, std::string_view what, std::int64_t otherwise,
                           std::int64_t least, std::int64_t most) const {
  const double value = number(place, what, static_cast<double>(otherwise), static_cast<double>(least),
                              static_cast<double>(most));
  if (value != std::floor(value)) {
    throw Error(ErrorCode::kUsage, fmt::format("'{}' is no {} of '{}'", parameters[place], what, name),
                fmt::format("give a whole number from {} to {}", least, most));
  }
  return static_cast<std::int64_t>(value);
}

void Choice::takes_at_most(std::size_t most) const {
  if (parameters.size() <= most) return;
  throw Error(ErrorCode::kUsage,
              most == 0 ? fmt::format("'{}' takes no parameter", name)
                        : fmt::format("'{}' takes at most {} parameters", name, most),
              fmt::format("leave '{}' out", parameters[most]));
}

std::string Choice::text() const {
  return parameters.empty() ? name : fmt::format("{}={}", name, fmt::join(parameters, ","));
}

Choice parse_choice(std::string_view text) {
  Choice choice;
  const std::size_t equals = text.find('=');
  choice.name = text.substr(0, equals);
  if (equals == std::string_view::npos) return choice;
  for (const std::string_view part : text::split(text.substr(equals + 1), ',')) {
    choice.parameters.emplace_back(part);
  }
  return choice;
}

}  // namespace footwall::extract
