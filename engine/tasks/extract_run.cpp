#include "engine/tasks/extract_run.h"

#include <numeric>

#include "engine/session/private_folder.h"
#include "engine/tasks/attach.h"
#include "engine/tasks/job_home.h"

namespace footwall::tasks {

Extracted extract_run(project::Project& project, const ExtractOptions& options, const JobContext& context) {
  JobOfProject made = job_of_project(project, options, FreshMeshes::kStored, context.part(0, 0.05));
  session::Job& job = made.job;
  const session::PrivateFolder folder(home_of_job(project));
  job.output = folder.path() / "parts";
  const std::filesystem::path job_file = folder.path() / "JOB.json";
  session::write_job(job, job_file);

  Extracted done;
  done.volume = job.volume_name;
  done.triangulated = std::move(made.triangulated);
  done.skipped = std::move(made.skipped);
  done.result_json = session::run_engine(options.launch, job_file, context.part(0.05, 0.98));
  std::vector<std::size_t> all(job.faults.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  done.run = attach_parts(project, job, all, done.result_json, "");
  context.report(1, "attached");
  return done;
}

}  // namespace footwall::tasks
