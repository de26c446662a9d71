#include "app/footwall/commands/volume_input.h"

#include <fmt/format.h>

#include "app/footwall/commands/import.h"
#include "storage/base/error.h"
#include "storage/base/log.h"

namespace footwall::commands {
namespace {

VolumeKind told(const std::filesystem::path& file) {
  if (formats::nrrd::looks_like_nrrd(file)) return VolumeKind::kNrrd;
  if (formats::segy::looks_like_segy(file)) return VolumeKind::kSegy;
  std::error_code failure;
  if (!std::filesystem::exists(file, failure) && !failure) {
    throw Error(ErrorCode::kNotFound, fmt::format("there is no file {}", file.string()));
  }
  throw Error(ErrorCode::kFormat, file.string() + " looks like neither SEG-Y nor NRRD",
              "for raw float32 samples add --raw and --dims");
}

}  // namespace

VolumeInput volume_input(const std::filesystem::path& file, VolumeKind kind, const VolumeOptions& options,
                         const ShapeOptions& shape, const std::optional<survey::Geometry>& survey,
                         const std::filesystem::path& scratch, const JobContext& job) {
  if (kind == VolumeKind::kTold) kind = told(file);
  VolumeInput input;
  switch (kind) {
    case VolumeKind::kSegy: {
      if (survey) options.agree_but_for_interval(*survey);
      tasks::SegyImport import = tasks::segy_source(file, options.segy(), job);
      input.source = std::move(import.source);
      input.warnings = import.report.warnings;
      input.report.skipped = import.report.duplicates + import.report.dead_traces;
      break;
    }
    case VolumeKind::kNrrd:
      if (survey) options.agree_with(*survey);
      input.source = tasks::nrrd_source(file, options.nrrd(), survey, scratch, job);
      break;
    default: {
      if (survey) options.agree_with(*survey);
      const survey::Geometry geometry = survey ? *survey : options.raw_geometry();
      input.source = tasks::raw_source(file, options.raw(), geometry);
    }
  }
  input.source = shape.apply(std::move(input.source), survey, input.warnings);
  input.report.assumed = input.source.geometry.assumed;
  return input;
}

console::Output volume_output(const project::VolumeRecord& volume, const VolumeInput& input) {
  const bool any = volume.null_count < volume.dims[0] * volume.dims[1] * volume.dims[2];
  formats::ImportReport report = input.report;
  report.read = volume.live_traces;
  console::Output output;
  output.json = report_json(report);
  output.json["volume"] = volume.name;
  output.json["dims"] = volume.dims;
  output.json["min"] = any ? console::Json(volume.min) : console::Json();
  output.json["max"] = any ? console::Json(volume.max) : console::Json();
  output.json["live_traces"] = volume.live_traces;
  output.json["null_count"] = volume.null_count;
  output.json["checksum"] = volume.checksum;
  std::vector<std::string> warnings = input.warnings;
  if (input.source.notes_after_reading) {
    for (std::string& note : input.source.notes_after_reading()) warnings.push_back(std::move(note));
  }
  output.json["warnings"] = warnings;
  output.text = fmt::format(
      "volume {}: {} inlines x {} crosslines x {} samples, {}, {} live traces\n", volume.name, volume.dims[0],
      volume.dims[1], volume.dims[2],
      any ? fmt::format("amplitudes {:.6g} to {:.6g}", volume.min, volume.max) : "every sample null",
      volume.live_traces);
  output.text += report_text(report);
  for (const std::string& warning : warnings) log::warn(warning);
  return output;
}

}  // namespace footwall::commands
