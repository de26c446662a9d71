#include "app/footwall/commands/segy_info.h"

#include <fmt/format.h>

#include "storage/formats/segy/segy_file.h"

namespace footwall::commands {
namespace {

console::Json segy_json(const formats::segy::Report& report, const survey::Geometry& geometry) {
  const auto lines = [](const survey::LineAxis& axis) {
    return console::Json{
        {"first", axis.first}, {"last", axis.last()}, {"step", axis.step}, {"count", axis.count}};
  };
  return {{"format", report.format},
          {"format_name", report.format_name},
          {"endian", formats::segy::name_of(report.endian)},
          {"revision", fmt::format("{}.{}", report.revision_major, report.revision_minor)},
          {"traces", report.traces},
          {"samples", report.samples},
          {"interval_us", report.interval_us},
          {"inlines", lines(geometry.inlines)},
          {"crosslines", lines(geometry.crosslines)},
          {"live_traces", report.live_traces},
          {"dead_traces", report.dead_traces},
          {"duplicates", report.duplicates},
          {"missing_bins", report.missing_bins},
          {"fit_residual", report.residual},
          {"right_handed", report.right_handed},
          {"assumed", geometry.assumed},
          {"warnings", report.warnings}};
}

std::string segy_text(const console::Json& facts) {
  std::string text;
  for (const auto& [key, value] : facts.items()) {
    if (value.is_array()) continue;
    text += fmt::format("{:14} {}\n", key, value.is_string() ? value.get<std::string>() : value.dump());
  }
  for (const char* list : {"assumed", "warnings"}) {
    for (const console::Json& line : facts[list])
      text += fmt::format("{}: {}\n", list, line.get<std::string>());
  }
  return text;
}

}  // namespace

console::Output segy_info(const std::string& file, const console::Console& console) {
  // Only headers are reported, which read the same whatever z means.
  const auto scanned = formats::segy::SegyFile::scan(file, {}, console.job());
  console::Output output;
  output.json = segy_json(scanned.report(), scanned.geometry());
  output.text = segy_text(output.json);
  return output;
}

}  // namespace footwall::commands
