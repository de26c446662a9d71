// What a volume's import takes of the file, and onto which grid: crop and resample, for every kind of file.
#pragma once
#include <string>
#include <vector>

#include "app/footwall/console/program.h"
#include "engine/tasks/crop_volume.h"

namespace footwall::commands {

struct ShapeOptions {
  std::string inlines, crosslines, z, resample;

  void add_to(CLI::App& command);
  bool given() const { return !(inlines.empty() && crosslines.empty() && z.empty() && resample.empty()); }
  // survey: of the project, if it has one. Throws kUsage for what cannot be read, and what cropped(),
  // regridded() and on_survey() throw.
  tasks::VolumeSource apply(tasks::VolumeSource source, const std::optional<survey::Geometry>& survey,
                            std::vector<std::string>& notices) const;
};

}  // namespace footwall::commands
