// footwall-engine batch JOB.json
#pragma once
#include <filesystem>

#include "engine/comm/communicator.h"
#include "engine/session/batch.h"

namespace footwall::app {

// Runs the job with progress on rank 0's standard error, as JSON lines {"progress": {fraction, phase,
// amounts}}; SIGINT, SIGTERM and SIGUSR1 cancel it. Collective; throws what run_batch throws.
void batch(const comm::Communicator& world, const std::filesystem::path& job,
           const session::BatchOptions& options);

// Whether this rank got SIGTERM: how batch systems ask for their processors, before they kill.
bool told_to_make_room();

// One line {"error": {code, message, hint}} on standard error.
void print_error(const Error& error);

}  // namespace footwall::app
