// Faces with the statistics of a run into a file whose suffix names the format.
#pragma once
#include <filesystem>
#include <string>

#include "engine/tasks/face_tables.h"

namespace footwall::tasks {

struct FacesExported {
  std::string run;  // its name; empty: there is none, and so no statistics
  std::int64_t faults = 0, faces = 0;
  std::vector<std::string> stale;    // faults edited since the run: their faces are those of the run
  std::vector<std::string> renamed;  // "old -> new", names that the format cannot hold
};

// .csv (z down), .vtp (z up) or .ts (z down), in world coordinates; the faces and the run as face_tables()
// says. Throws kUsage for another suffix, kInvalid where there are no faces, and what face_tables() and the
// writers throw.
FacesExported export_faces(const project::Project& project, const std::filesystem::path& file,
                           const std::string& fault, std::optional<std::int64_t> run);

// Its second half, which needs no project and so may run on any thread.
FacesExported write_faces(const FaceTables& faces, const std::filesystem::path& file);

}  // namespace footwall::tasks
