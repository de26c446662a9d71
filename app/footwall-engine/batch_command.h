// footwall-engine batch JOB.json
#pragma once
#include <filesystem>

#include "engine/comm/communicator.h"
#include "engine/session/batch.h"

namespace footwall::app {

// From now on SIGINT, SIGTERM and SIGUSR1 do not end the program, but cancel its job, also one that has not
// begun. Call it before MPI_Init, which takes a while.
void heed_signals();

// Runs the job with progress on rank 0's standard error, as JSON lines {"progress": {fraction, phase,
// amounts}}. Collective; throws what run_batch throws.
void batch(const comm::Communicator& world, const std::filesystem::path& job,
           const session::BatchOptions& options);

// Whether this rank got SIGTERM: how batch systems ask for their processors, before they kill.
bool told_to_make_room();

// One line {"error": {code, message, hint}} on standard error.
void print_error(const Error& error);

}  // namespace footwall::app
