// The commands' jobs on an engine that runs already: what --engine is.
#pragma once
#include <memory>

#include "engine/service/client/connection_file.h"
#include "engine/session/launch.h"

namespace footwall::service {

// For session::LaunchOptions::running. Connects for each task. Nothing is read or written by the engine where
// the job says: files travel with the call, volumes are named by their checksums (and by path where the
// engine is on this host). Its outputs take their names when all of them have arrived; but parts of a batch
// job each by itself, so that the next run goes on with them: they are sent along with the job.
std::shared_ptr<session::RunningEngine> running_tasks(const Connection& connection);

}  // namespace footwall::service
