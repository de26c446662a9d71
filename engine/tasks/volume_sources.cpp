#include "engine/tasks/volume_sources.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine/synthetic/faulted.h"
#include "storage/base/error.h"
#include "storage/formats/raw.h"

namespace footwall::tasks {

SegyImport segy_source(const std::filesystem::path& path, const formats::segy::Options& options,
                       const JobContext& job) {
  auto file = std::make_shared<formats::segy::SegyFile>(formats::segy::SegyFile::scan(path, options, job));
  const formats::segy::Report& report = file->report();
  SegyImport import{{}, report};
  import.source.geometry = file->geometry();
  import.source.text = "SEG-Y " + path.filename().string();
  import.source.provenance_json =
      nlohmann::json{{"importer", "segy"},      {"file", std::filesystem::absolute(path).string()},
                     {"format", report.format}, {"endian", formats::segy::name_of(report.endian)},
                     {"traces", report.traces}, { "residual", report.residual }}
          .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  import.source.fill = [file](const survey::Box& box, std::span<float> values, std::span<std::uint8_t> live) {
    file->read_block(box, values, live);
};
import.source.notes_after_reading = [file]()->std::vector<std::string> {
  if (file->overflowed() == 0) return {};
return {fmt::format("{} samples are beyond what a float32 holds and were set to its largest value",
                    file->overflowed())};
};  // namespace footwall::tasks
return import;
}

VolumeSource raw_source(const std::filesystem::path& path, const RawOptions& options,
                        const survey::Geometry& geometry) {
  if (options.dims != geometry.dims()) {
    const survey::Index want = geometry.dims();
    throw Error(ErrorCode::kInvalid,
                fmt::format("--dims {}x{}x{}, the project's survey has {}x{}x{}", options.dims[0],
                            options.dims[1], options.dims[2], want[0], want[1], want[2]),
                "a raw volume must cover the whole survey");
  }
  auto file = std::make_shared<formats::raw::RawFile>(
      path, options.dims, formats::raw::axis_order_from(options.axes), options.big_endian);
  VolumeSource source;
  source.geometry = geometry;
  source.null_value = options.null_value;
  source.text = "raw float32 " + path.filename().string();
  source.provenance_json = nlohmann::json{{"importer", "raw"},
                                          {"file", std::filesystem::absolute(path).string()},
                                          {"axes", options.axes},
                                          {"endian", options.big_endian ? "big" : "little"}}
                               .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  source.fill = [file](const survey::Box& box, std::span<float> values, std::span<std::uint8_t>) {
    file->read_block(box, values);
  };
  return source;
}

survey::Geometry plain_geometry(const survey::Index& dims, survey::Domain domain, survey::VerticalUnit unit,
                                double interval) {
  survey::Geometry geometry;
  geometry.inlines.count = dims[0];
  geometry.crosslines.count = dims[1];
  geometry.samples = dims[2];
  geometry.interval = interval;
  geometry.domain = domain;
  geometry.vertical_unit = unit;
  geometry.assumed = {"inlines and crosslines are numbered from 1",
                      "bins are 1 m x 1 m, X along crosslines, Y along inlines", "the first sample is at 0"};
  geometry.validate();
  return geometry;
}

VolumeSource nrrd_source(const std::filesystem::path& path, const NrrdOptions& options,
                         const std::optional<survey::Geometry>& survey, const std::filesystem::path& scratch,
                         const JobContext& job) {
  auto file = std::make_shared<formats::nrrd::NrrdFile>(path, scratch, job);
  const formats::nrrd::Header& header = file->header();
  const formats::raw::AxisOrder order =
      options.axes.empty() ? default_order(header) : formats::raw::axis_order_from(options.axes);
  formats::nrrd::Meaning meaning = options.meaning;
  if (survey) {
    meaning.domain_otherwise = survey->domain;
    meaning.unit_otherwise = survey->vertical_unit;
  }
  formats::nrrd::Placed placed = geometry_of(header, order, meaning);
  if (survey && !placed.complete) {
    const survey::Index dims = placed.geometry.dims();
    const survey::Index want = survey->dims();
    if (dims != want) {
      throw Error(
          ErrorCode::kInvalid,
          fmt::format("{} has {}x{}x{} samples and no place in space, the project's survey has {}x{}x{}",
                      path.string(), dims[0], dims[1], dims[2], want[0], want[1], want[2]),
          "a volume without a place must cover the whole survey; --axes says which axis is which");
    }
    if (placed.interval_stated &&
        std::abs(placed.geometry.interval - survey->interval) > 1e-6 * survey->interval) {
      throw Error(ErrorCode::kInvalid,
                  fmt::format("{} has a sample interval of {}, the survey has {}", path.string(),
                              placed.geometry.interval, survey->interval));
    }
    placed.geometry = *survey;
    placed.geometry.assumed = {"the volume lies where the survey does: the file does not say where it is"};
  }
  VolumeSource source;
  source.geometry = placed.geometry;
  source.null_value = options.null_value;
  source.text = "NRRD " + path.filename().string();
  source.provenance_json = nlohmann::json{
      {"importer", "nrrd"},
      {"file", std::filesystem::absolute(path).string()},
      {"type", name_of(header.type)},
      {"axes", formats::raw::name_of(
                   order)}}.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  source.fill = [file, order](const survey::Box& box, std::span<float> values, std::span<std::uint8_t>) {
    file->read_block(order, box, values);
  };
  return source;
}

VolumeSource synthetic_source(const synthetic::FaultedSurvey& made, const std::string& name) {
  VolumeSource source;
  source.geometry = made.geometry();
  source.text = "synthetic " + name;
  source.provenance_json = made.description_json();
  source.fill = [&made](const survey::Box& box, std::span<float> values, std::span<std::uint8_t>) {
    made.fill(box, values);
  };
  return source;
}

}  // namespace footwall::tasks
