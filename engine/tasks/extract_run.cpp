#include "engine/tasks/extract_run.h"

#include <numeric>
#include <utility>

#include "engine/tasks/attach.h"
#include "engine/tasks/job_home.h"

namespace footwall::tasks {

PreparedRun prepare_run(project::Project& project, const ExtractOptions& options, const JobContext& context) {
  PreparedRun prepared{job_of_project(project, options, FreshMeshes::kStored, context), nullptr};
  prepared.folder = std::make_unique<session::PrivateFolder>(home_of_job(project));
  prepared.made.job.output = prepared.folder->path() / "parts";
  return prepared;
}

std::string launch_run(const PreparedRun& prepared, const session::LaunchOptions& launch,
                       const JobContext& context) {
  const std::filesystem::path job_file = prepared.folder->path() / "JOB.json";
  session::write_job(prepared.made.job, job_file);
  return session::run_engine(launch, job_file, context);
}

Extracted attach_run(project::Project& project, const PreparedRun& prepared, std::string result_json) {
  const session::Job& job = prepared.made.job;
  Extracted done;
  done.volume = job.volume_name;
  done.triangulated = prepared.made.triangulated;
  done.skipped = prepared.made.skipped;
  done.result_json = std::move(result_json);
  std::vector<std::size_t> all(job.faults.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  done.run = attach_parts(project, job, all, done.result_json, "");
  return done;
}

Extracted extract_run(project::Project& project, const ExtractOptions& options, const JobContext& context) {
  const PreparedRun prepared = prepare_run(project, options, context.part(0, 0.05));
  Extracted done =
      attach_run(project, prepared, launch_run(prepared, options.launch, context.part(0.05, 0.98)));
  context.report(1, "attached");
  return done;
}

}  // namespace footwall::tasks
