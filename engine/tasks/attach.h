// Brings the results of a batch job into the project that it was written from, as a run.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/session/job.h"
#include "storage/base/job_context.h"
#include "storage/project/project.h"

namespace footwall::tasks {

struct AttachOptions {
  std::string name;      // of the run; empty: the job's, or "run N"
  bool partial = false;  // also attach where some faults are not computed yet
};

struct StaleFault {
  std::string fault;
  std::int64_t faces = 0;  // of the run
  std::int64_t stale = 0;  // of them, those that the fault no longer has at that place
};

struct Attached {
  std::int64_t run = 0;
  std::string volume;
  std::string result_json;           // as the engine's (session/batch.h); null what a job that has not ended
                                     // does not know
  std::vector<StaleFault> stale;     // faults edited since
  std::vector<std::string> missing;  // faults whose part is not there
};

// `folder` holds JOB.json, or is JOB.json itself. All or nothing. Throws kNotFound (no job there, or a fault
// that the project no longer has), kInvalid (results of another volume or another project, faults not
// computed yet, attached before), kCorrupt and kFormat (damaged files).
Attached attach_folder(project::Project& project, const std::filesystem::path& folder,
                       const AttachOptions& options, const JobContext& context);

// The parts of `job` (output set) as a run of the project; used by `extract` too. `faults`: places in
// job.faults whose parts there are. job_name: what marks the run as that of a job folder, or "".
std::int64_t attach_parts(project::Project& project, const session::Job& job,
                          const std::vector<std::size_t>& faults, const std::string& result_json,
                          const std::string& job_name);

}  // namespace footwall::tasks
