// Fault sticks from a file become faults and pillars, as one undoable edit.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "storage/formats/sticks.h"
#include "storage/project/project.h"

namespace footwall::tasks {

struct SticksImported {
  formats::ImportReport report;
  std::vector<std::string> faults;  // made by this import
  std::int64_t pillars = 0;
  std::vector<std::string> notices;  // e.g. sticks that lie outside the survey
};

// format: "charisma" or empty (told from the content). A fault whose name the project has already gets a new
// name, noted in report.renamed. Throws kUsage for a format that is not built, and what reading throws.
SticksImported import_sticks(project::Project& project, const std::filesystem::path& file,
                             const std::string& format, const formats::SticksOptions& options);

}  // namespace footwall::tasks
