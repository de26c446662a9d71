// footwall-engine batch JOB.json
#pragma once
#include <filesystem>

#include "engine/comm/communicator.h"
#include "engine/session/batch.h"

namespace footwall::app {

// Runs the job as running_job.h says. Collective; throws what run_batch throws.
void batch(const comm::Communicator& world, const std::filesystem::path& job,
           const session::BatchOptions& options);

}  // namespace footwall::app
