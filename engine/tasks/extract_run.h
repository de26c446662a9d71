// EXTRACT-ALL on the faults of a project: triangulates what is stale, launches the engine, attaches the
// result.
#pragma once
#include <string>
#include <vector>

#include "engine/tasks/job_of_project.h"

namespace footwall::tasks {

struct Extracted {
  std::int64_t run = 0;
  std::string volume;
  std::string result_json;                // the engine's answer, see session/batch.h
  std::vector<std::string> triangulated;  // faults whose mesh was made first
  std::vector<std::string> skipped;       // faults that could not be made a surface, with the reason
};

// Throws kUsage for names that are not built, kInvalid where no fault has a surface, kNotFound for a missing
// volume, kEngine, and the engine's own errors. A failure or cancel leaves the runs as they were.
Extracted extract_run(project::Project& project, const ExtractOptions& options, const JobContext& job);

}  // namespace footwall::tasks
