#include "engine/tasks/section_plane.h"

#include <fmt/format.h>

#include <cmath>

#include "storage/base/error.h"
#include "storage/base/text.h"

namespace footwall::tasks {

SectionPlane section_plane(const std::string& words, const survey::Geometry& survey) {
  const auto equals = words.find('=');
  const std::string axis = words.substr(0, equals);
  const std::string at = equals == std::string::npos ? "" : words.substr(equals + 1);
  const auto wrong = [&] {
    return Error(ErrorCode::kUsage, fmt::format("'{}' is not a section", words),
                 "write inline=N, crossline=N or z=VALUE; first, middle and last are numbers too");
  };
  SectionPlane plane;
  if (axis == "inline")
    plane.axis = 0;
  else if (axis == "crossline")
    plane.axis = 1;
  else if (axis == "z")
    plane.axis = 2;
  else
    throw wrong();

  const std::int64_t count = survey.dims()[static_cast<std::size_t>(plane.axis)];
  if (at == "first") return plane;
  if (at == "middle" || at == "last") {
    plane.index = at == "last" ? count - 1 : count / 2;
    return plane;
  }
  const auto number = text::number(at);
  if (!number) throw wrong();
  std::string range;
  if (plane.axis == 2) {
    plane.index = static_cast<std::int64_t>(std::nearbyint((*number - survey.z0) / survey.interval));
    range =
        fmt::format("{} to {} {}", survey.z0, survey.z0 + survey.interval * static_cast<double>(count - 1),
                    name_of(survey.vertical_unit));
  } else {
    const survey::LineAxis& lines = plane.axis == 0 ? survey.inlines : survey.crosslines;
    const auto line = static_cast<std::int64_t>(*number);
    plane.index = static_cast<double>(line) == *number && line >= lines.first ? lines.index_of(line) : -1;
    range = fmt::format("{} to {} by {}", lines.first, lines.last(), lines.step);
  }
  if (plane.index < 0 || plane.index >= count) {
    throw Error(ErrorCode::kInvalid, fmt::format("the survey has no {}", words),
                fmt::format("it has {} {}", axis, range));
  }
  return plane;
}

}  // namespace footwall::tasks
