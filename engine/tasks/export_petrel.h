// A folder of files that Petrel loads: fault sticks, attributes at the faces' centroids, surfaces, and a
// note.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "storage/project/project.h"

namespace footwall::tasks {

struct PetrelOptions {
  std::string fault;                // empty: all
  std::optional<std::int64_t> run;  // of the attributes; none: the last
  bool z_positive_up = true;        // as Petrel has it: elevation, negative below the datum
  std::string z_unit;               // "ms", "s", "m", "ft"; empty: the survey's
};

struct PetrelExport {
  std::vector<std::string> files;
  std::vector<std::string> renamed;  // "old -> new", names that a format cannot hold
  std::vector<std::string> notices;
};

// Writes fault_sticks.txt (Charisma, with true inline and crossline where there is a survey), face_points.txt
// (X Y Z fault face and every statistic, one row a face, -99999 = undefined), faults.ts (GOCAD TSurf) and
// README.txt; what the project has nothing for is left out. Files of these names are replaced. Throws
// kInvalid where there are neither pillars nor faces, kUsage for a unit of the other domain, kIo.
PetrelExport export_petrel(const project::Project& project, const std::filesystem::path& folder,
                           const PetrelOptions& options);

}  // namespace footwall::tasks
