// The batch job that EXTRACT-ALL on a project's faults is: what `extract` runs, what --dry-run looks at and
// what --write-job writes.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/session/job.h"
#include "engine/session/launch.h"
#include "engine/tasks/fault_faces.h"
#include "storage/base/job_context.h"
#include "storage/project/project.h"

namespace footwall::tasks {

struct ExtractOptions {
  std::string volume;  // empty: the first one
  std::string fault;   // empty: all
  std::string name;    // of the run; empty: "run N"
  extract::Options engine;
  session::LaunchOptions launch;
  std::optional<double> velocity;    // m/s, for metres in a time survey
  std::vector<std::int64_t> faults;  // ids; where there are any, these and not `fault`
};

// Those that the options name. Throws kNotFound for one that is not there, and for a project without faults.
std::vector<project::FaultRecord> faults_of(const project::Project& project, const ExtractOptions& options);

struct JobOfProject {
  session::Job job;                       // volume absolute; output still empty
  std::vector<std::string> triangulated;  // faults whose mesh was made first
  std::vector<std::string> skipped;       // faults that could not be made a surface, with the reason
};

// With kThrownAway the project is not written to, and may be open for reading only. Throws kUsage for names
// that are not built, kInvalid where no fault has a surface, kNotFound for a missing volume.
JobOfProject job_of_project(project::Project& project, const ExtractOptions& options, FreshMeshes meshes,
                            const JobContext& context);

}  // namespace footwall::tasks
