#include "app/footwall/commands/options.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/tasks/triangulate.h"
#include "storage/base/log.h"
#include "storage/base/text.h"
#include "storage/formats/missing_options.h"

namespace footwall::commands {
namespace {

Error wrong(const std::string& option, const std::string& text, const std::string& form) {
  return {ErrorCode::kUsage, fmt::format("{} '{}' cannot be read", option, text), "write it as " + form};
}

[[noreturn]] void differs(const std::string& option, const std::string& given, const std::string& has) {
  throw Error(ErrorCode::kInvalid, fmt::format("{} {}, the project's survey has {}", option, given, has),
              "leave the option out, or import into a project of its own");
}

}  // namespace

std::array<std::int64_t, 3> dims_from(const std::string& text, const std::string& option) {
  // 256x256x128 and 256,256,128 mean the same.
  const auto parts = text::split(text, text.find(',') == std::string::npos ? 'x' : ',');
  std::array<std::int64_t, 3> dims{};
  if (parts.size() != 3) throw wrong(option, text, "inlines x crosslines x samples, e.g. 256x256x256");
  for (std::size_t n = 0; n < 3; ++n) {
    const auto number = text::integer(parts[n]);
    if (!number || *number < 1) throw wrong(option, text, "inlines x crosslines x samples, e.g. 256x256x256");
    dims[n] = *number;
  }
  return dims;
}

std::array<int, 2> picture_size_from(const std::string& text) {
  constexpr std::int64_t kMost = 16384;
  const auto parts = text::split(text, 'x');
  const auto width = parts.size() == 2 ? text::integer(parts[0]) : std::nullopt;
  const auto height = parts.size() == 2 ? text::integer(parts[1]) : std::nullopt;
  if (!width || !height || *width < 16 || *height < 16 || *width > kMost || *height > kMost) {
    throw wrong("--size", text, "width x height in pixels, 16 to 16384 each, e.g. 1600x1000");
  }
  return {static_cast<int>(*width), static_cast<int>(*height)};
}

std::optional<double> group_threshold_from(const std::string& text) {
  if (text == "auto") return std::nullopt;
  const auto threshold = text::number(text);
  if (!threshold || !std::isfinite(*threshold))
    throw wrong("--group-threshold", text, "auto, or a number as 0.1");
  return threshold;
}

std::array<double, 2> range_from(const std::string& text, const std::string& option) {
  const auto parts = text::split(text, ':');
  const auto lo = parts.size() == 2 ? text::number(parts[0]) : std::nullopt;
  const auto hi = parts.size() == 2 ? text::number(parts[1]) : std::nullopt;
  if (!lo || !hi || !(*lo < *hi)) throw wrong(option, text, "low:high, e.g. 0:2.5");
  return {*lo, *hi};
}

project::Project open_project(const std::string& path, project::OpenMode mode) {
  project::Project project = project::Project::open(path, mode);
  for (const std::string& notice : project.notices()) log::info(notice);
  if (mode == project::OpenMode::kWrite) tasks::follow_parents(project);
  return project;
}

void VolumeOptions::add_to(CLI::App& command) {
  command.add_option("--domain", domain,
                     "What z is: time or depth (SEG-Y, raw and most NRRD files cannot tell)");
  command.add_option("--vertical-unit", vertical_unit, "Unit of z: ms, m or ft");
  command.add_option("--crs", crs, "Coordinate reference system of X and Y, as text");
  command.add_option("--interval", interval,
                     "Sample interval in the vertical unit, where the file's is wrong or not there");
  headers.add_to(command);
  command.add_option("--dims", dims, "Raw: inlines x crosslines x samples, e.g. 256x256x128");
  command.add_option(
      "--axes", axes,
      "Raw, NRRD: axes from the slowest to the fastest; i inline, j crossline, k sample (raw ijk, NRRD kji)");
  command.add_option("--null", null_value,
                     "Raw, NRRD: the value that stands for 'no value' (NaN always does)");
}

void VolumeOptions::check_samples() const {
  std::vector<formats::MissingOption> missing;
  if (!domain) missing.push_back(formats::kMissingDomain);
  if (!vertical_unit) missing.push_back(formats::kMissingUnit);
  formats::refuse_missing(missing);
  const survey::Domain chosen = survey::domain_from(*domain);
  const survey::VerticalUnit unit = survey::vertical_unit_from(*vertical_unit);
  if ((chosen == survey::Domain::kTime) != (unit == survey::VerticalUnit::kMillisecond)) {
    throw Error(ErrorCode::kUsage,
                fmt::format("--domain {} does not go with --vertical-unit {}", *domain, *vertical_unit),
                "time is in ms, depth in m or ft");
  }
  check_interval();
}

void VolumeOptions::check_interval() const {
  if (interval && !(*interval > 0 && std::isfinite(*interval))) {
    throw Error(ErrorCode::kUsage, fmt::format("--interval {} is no sample interval", *interval),
                "give a number above 0, in the vertical unit");
  }
}

formats::segy::Options VolumeOptions::segy() const {
  check_samples();
  formats::segy::Options options = headers.to_options();
  options.domain = survey::domain_from(*domain);
  options.vertical_unit = survey::vertical_unit_from(*vertical_unit);
  options.interval = interval;
  options.crs = crs;
  return options;
}

tasks::RawOptions VolumeOptions::raw() const {
  if (dims.empty()) formats::refuse_missing({formats::kMissingDims});
  return {dims_from(dims, "--dims"), axes.empty() ? "ijk" : axes, headers.endian && *headers.endian == "big",
          null_value};
}

tasks::NrrdOptions VolumeOptions::nrrd() const {
  check_interval();
  tasks::NrrdOptions options;
  options.axes = axes;
  options.null_value = null_value;
  if (domain) options.meaning.domain = survey::domain_from(*domain);
  if (vertical_unit) options.meaning.vertical_unit = survey::vertical_unit_from(*vertical_unit);
  options.meaning.interval = interval;
  options.meaning.crs = crs;
  return options;
}

void VolumeOptions::agree_with(const survey::Geometry& survey) const {
  agree_but_for_interval(survey);
  if (interval && !(std::abs(*interval - survey.interval) <= 1e-9 * survey.interval)) {
    differs("--interval", fmt::format("{}", *interval), fmt::format("{}", survey.interval));
  }
}

void VolumeOptions::agree_but_for_interval(const survey::Geometry& survey) const {
  if (domain && survey::domain_from(*domain) != survey.domain) {
    differs("--domain", *domain, std::string(name_of(survey.domain)));
  }
  if (vertical_unit && survey::vertical_unit_from(*vertical_unit) != survey.vertical_unit) {
    differs("--vertical-unit", *vertical_unit, std::string(name_of(survey.vertical_unit)));
  }
  if (!crs.empty() && !survey.crs.empty() && crs != survey.crs) differs("--crs", crs, survey.crs);
}

survey::Geometry VolumeOptions::raw_geometry() const {
  std::vector<formats::MissingOption> missing;
  if (dims.empty()) missing.push_back(formats::kMissingDims);
  if (!domain) missing.push_back(formats::kMissingDomain);
  if (!vertical_unit) missing.push_back(formats::kMissingUnit);
  if (!interval) missing.push_back(formats::kMissingInterval);
  formats::refuse_missing(missing);
  check_samples();
  survey::Geometry geometry = tasks::plain_geometry(raw().dims, survey::domain_from(*domain),
                                                    survey::vertical_unit_from(*vertical_unit), *interval);
  geometry.crs = crs;
  return geometry;
}

}  // namespace footwall::commands
