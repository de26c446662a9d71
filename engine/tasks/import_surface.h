// GOCAD surfaces from a file become faults with a ready mesh, as one undoable edit.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "storage/base/job_context.h"
#include "storage/formats/import_report.h"
#include "storage/project/project.h"

namespace footwall::tasks {

struct SurfaceImportOptions {
  std::string name;                   // of the fault; empty: as in the file
  std::optional<bool> z_positive_up;  // none: as the file says
  std::string z_unit;                 // "ms", "s", "m", "ft"; empty: as the file says
};

struct ImportedSurface {
  std::string fault;
  std::int64_t vertices = 0;
  std::int64_t triangles = 0;
};

struct SurfacesImported {
  formats::ImportReport report;
  std::vector<ImportedSurface> faults;  // made by this import, one a TSurf object
  std::vector<std::string> notices;     // converted units, properties that were left out, lies outside, cuts
};

// Coordinates go into the survey's units; without a survey they stay the file's, with z positive down. The
// meshes are made at once. A name that the project has already, or cannot have, is changed and told. Throws
// kInvalid for a z in time where the survey is in depth and the other way round, and what reading throws; the
// project then stays as it was.
SurfacesImported import_surface(project::Project& project, const std::filesystem::path& file,
                                const SurfaceImportOptions& options, const JobContext& job);

}  // namespace footwall::tasks
