// A job as a folder that can be carried to a cluster: `extract --write-job`.
#pragma once
#include <filesystem>

#include "engine/session/job.h"
#include "engine/tasks/forecast.h"
#include "storage/base/job_context.h"

namespace footwall::tasks {

// Makes `folder` (which must not exist, or be empty) with JOB.json, JOB.faces, job.sbatch and README.txt;
// whole or not at all. with_volume: also volume.h5, sharing its bytes with the project's file where the file
// system can, and the job names it relative to itself; else the job has the absolute path. Throws kInvalid
// (there is something in the folder), kIo, kCancelled.
void write_job_folder(const session::Job& job, const Forecast& forecast, const std::filesystem::path& folder,
                      bool with_volume, const JobContext& context);

}  // namespace footwall::tasks
