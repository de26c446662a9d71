#include "app/footwall/commands/shape_options.h"

#include <fmt/format.h>

#include <cmath>

#include "app/footwall/commands/options.h"
#include "engine/tasks/resample_volume.h"
#include "storage/base/error.h"
#include "storage/base/text.h"

namespace footwall::commands {
namespace {

// "a:b", "a:b:s", "a:", ":b" or a single "a".
template <class Range, class Number>
std::optional<Range> range_of(const std::string& text, const std::string& option, const std::string& example,
                              const Number& number) {
  if (text.empty()) return std::nullopt;
  const Error wrong{ErrorCode::kUsage, fmt::format("{} '{}' cannot be read", option, text),
                    "write it as first:last or first:last:step, e.g. " + example};
  const auto parts = text::split(text, ':');
  if (parts.size() > 3) throw wrong;
  Range range;
  const auto set = [&](std::string_view part, auto& value) {
    if (part.empty()) return;
    value = number(part);
    if (!value) throw wrong;
  };
  set(parts[0], range.first);
  if (parts.size() == 1) range.last = range.first;
  if (parts.size() > 1) set(parts[1], range.last);
  if (parts.size() > 2) set(parts[2], range.step);
  if (range.first && range.last && *range.first > *range.last) {
    throw Error(ErrorCode::kUsage, fmt::format("{} '{}' ends before it begins", option, text),
                "write it as first:last, the smaller number first");
  }
  return range;
}

std::optional<double> finite(std::string_view word) {
  const auto value = text::number(word);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

}  // namespace

void ShapeOptions::add_to(CLI::App& command) {
  command.add_option("--inlines", inlines,
                     "Only these inlines, first:last[:step], in line numbers; step a multiple of the file's");
  command.add_option("--crosslines", crosslines, "Only these crosslines, first:last[:step]");
  command.add_option("--z", z, "Only these samples, first:last[:step] in the vertical unit");
  command.add_option(
      "--resample", resample,
      "New inlines x crosslines x samples over the same extent, or 'survey' for the project's grid");
}

tasks::VolumeSource ShapeOptions::apply(tasks::VolumeSource source,
                                        const std::optional<survey::Geometry>& survey,
                                        std::vector<std::string>& notices) const {
  tasks::Crop crop;
  crop.inlines = range_of<tasks::LineRange>(inlines, "--inlines", "100:200:2", text::integer);
  crop.crosslines = range_of<tasks::LineRange>(crosslines, "--crosslines", "100:200:2", text::integer);
  crop.z = range_of<tasks::DepthRange>(z, "--z", "1000:2000:8", finite);
  source = tasks::cropped(std::move(source), crop, notices);
  if (resample.empty()) return source;
  if (resample == "survey") {
    if (!survey) {
      throw Error(ErrorCode::kUsage, "--resample survey: the project has no survey yet",
                  "its first volume makes the survey; give dims, e.g. --resample 256x256x128");
    }
    const tasks::Regrid grid = tasks::on_survey(*survey, source.geometry);
    return tasks::resampled(std::move(source), grid);
  }
  const tasks::Regrid grid = tasks::regridded(source.geometry, dims_from(resample, "--resample"));
  return tasks::resampled(std::move(source), grid);
}

}  // namespace footwall::commands
