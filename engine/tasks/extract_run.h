// EXTRACT-ALL on the faults of a project: triangulates what is stale, launches the engine, attaches the
// result.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "engine/session/private_folder.h"
#include "engine/tasks/job_of_project.h"

namespace footwall::tasks {

struct Extracted {
  std::int64_t run = 0;
  std::string volume;
  std::string result_json;                // the engine's answer, see session/batch.h
  std::vector<std::string> triangulated;  // faults whose mesh was made first
  std::vector<std::string> skipped;       // faults that could not be made a surface, with the reason
};

// The same in three steps, where the project belongs to another thread than the wait for the engine.
struct PreparedRun {
  JobOfProject made;
  std::unique_ptr<session::PrivateFolder> folder;  // of the job and its parts; goes with this
};
// 1, the project's thread: stale meshes are made anew. Throws as extract_run().
PreparedRun prepare_run(project::Project& project, const ExtractOptions& options, const JobContext& context);
// 2, any thread: the engine's answer.
std::string launch_run(const PreparedRun& prepared, const session::LaunchOptions& launch,
                       const JobContext& context);
// 3, the project's thread.
Extracted attach_run(project::Project& project, const PreparedRun& prepared, std::string result_json);

// Throws kUsage for names that are not built, kInvalid where no fault has a surface, kNotFound for a missing
// volume, kEngine, and the engine's own errors. A failure or cancel leaves the runs as they were.
Extracted extract_run(project::Project& project, const ExtractOptions& options, const JobContext& job);

}  // namespace footwall::tasks
