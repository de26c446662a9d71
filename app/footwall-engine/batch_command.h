// footwall-engine batch JOB.json
#pragma once
#include <filesystem>

#include "engine/comm/communicator.h"

namespace footwall::app {

// Runs the job with progress on rank 0's standard error, as JSON lines {"progress": {fraction, phase,
// amounts}}; SIGINT, SIGTERM and SIGUSR1 cancel it. Collective; throws what run_batch throws.
void batch(const comm::Communicator& world, const std::filesystem::path& job);

// One line {"error": {code, message, hint}} on standard error.
void print_error(const Error& error);

}  // namespace footwall::app
