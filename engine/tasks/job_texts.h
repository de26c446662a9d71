// The texts that stand beside a job for those who run it: a script for Slurm, and how to go on.
#pragma once
#include <string>

#include "engine/session/job.h"
#include "engine/tasks/forecast.h"

namespace footwall::tasks {

// job.sbatch; `name`: of the job's folder. Memory is a quarter more than the forecast's, the time limit three
// times its seconds and ten minutes.
std::string job_script(const session::Job& job, const Forecast& forecast, const std::string& name);
// README.txt.
std::string job_readme(const session::Job& job, const Forecast& forecast);

}  // namespace footwall::tasks
