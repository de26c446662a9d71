#include "app/footwall-engine/batch_command.h"

#include "app/footwall-engine/running_job.h"

namespace footwall::app {

void batch(const comm::Communicator& world, const std::filesystem::path& job_path,
           const session::BatchOptions& options) {
  session::run_batch(world, job_path, running_job(world), options);
}

}  // namespace footwall::app
