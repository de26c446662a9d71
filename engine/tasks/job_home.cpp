#include "engine/tasks/job_home.h"

#include "engine/session/launcher.h"
#include "engine/session/private_folder.h"

namespace footwall::tasks {

std::filesystem::path home_of_job(const project::Project& project) {
  if (session::current_allocation().slurm) return std::filesystem::absolute(project.path()).parent_path();
  return session::temporary_home();
}

}  // namespace footwall::tasks
