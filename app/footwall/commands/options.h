// Options that several commands share.
#pragma once
#include <array>
#include <optional>
#include <string>

#include "app/footwall/commands/segy_options.h"
#include "app/footwall/console/program.h"
#include "engine/tasks/volume_sources.h"
#include "storage/project/project.h"

namespace footwall::commands {

// "256x256x128" or "1600x1000"; throws Error kUsage naming the option.
std::array<std::int64_t, 3> dims_from(const std::string& text, const std::string& option);
std::array<int, 2> picture_size_from(const std::string& text);
// Of --group-threshold: a number, or "auto" for none.
std::optional<double> group_threshold_from(const std::string& text);
// "lo:hi"
std::array<double, 2> range_from(const std::string& text, const std::string& option);

// Opens for reading or writing; notices go to the log, interpolated pillars follow their parents.
project::Project open_project(const std::string& path, project::OpenMode mode);

// How a volume's file is to be read: what `new --segy|--nrrd|--raw` and `import volume` have in common.
struct VolumeOptions {
  std::optional<std::string> domain, vertical_unit;
  SegyOptions headers;
  std::optional<double> interval;
  std::string crs;
  std::string dims;
  std::string axes;
  std::optional<float> null_value;

  void add_to(CLI::App& command);
  // Each throws kUsage that names every option it needs and was not given.
  formats::segy::Options segy() const;
  tasks::NrrdOptions nrrd() const;
  tasks::RawOptions raw() const;
  // For a raw file in a project without a survey.
  survey::Geometry raw_geometry() const;
  // Throws kInvalid with both where what was given is not the survey's: it is not overridden by a volume.
  void agree_with(const survey::Geometry& survey) const;
  // The same without the interval, which of a SEG-Y file may be wrong, or another one that is resampled.
  void agree_but_for_interval(const survey::Geometry& survey) const;

 private:
  // Throws kUsage where domain or unit are not given, or domain, unit and interval cannot belong together.
  void check_samples() const;
  void check_interval() const;
};

}  // namespace footwall::commands
