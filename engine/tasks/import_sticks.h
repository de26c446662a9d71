// Fault sticks from a file become faults and pillars, as one undoable edit.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "storage/base/job_context.h"
#include "storage/formats/sticks.h"
#include "storage/project/project.h"

namespace footwall::tasks {

struct SticksImported {
  formats::ImportReport report;
  std::string format;               // as it was read
  std::vector<std::string> faults;  // made by this import
  std::int64_t pillars = 0;
  std::vector<std::string> notices;  // e.g. sticks that lie outside the survey
};

// One point as it would be imported: X, Y, and z in the survey's vertical unit, positive down.
struct StickRow {
  std::string fault;
  std::int64_t stick = 0;
  survey::WorldPoint point;
};
struct SticksPreview {
  SticksImported counts;  // with the names that the faults would get
  std::vector<StickRow> rows;
  static constexpr std::size_t kRows = 20;
};

// format: a name of formats::stick_formats(), or empty (told from the content). options: survey and vertical
// unit are the project's, whatever is set; the file's stem names faults that have no name. A fault whose name
// the project has already gets a new one, noted in report.renamed. Throws kUsage for a format that is not
// built, kInvalid for sticks in line numbers where the project has no survey, and what reading throws.
SticksImported import_sticks(project::Project& project, const std::filesystem::path& file,
                             const std::string& format, const formats::SticksOptions& options,
                             const JobContext& job = {});

// The same without changing anything: the first rows, and what the import would report.
SticksPreview preview_sticks(const project::Project& project, const std::filesystem::path& file,
                             const std::string& format, const formats::SticksOptions& options);

}  // namespace footwall::tasks
