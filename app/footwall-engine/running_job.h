// The one job that this process runs: its cancel by signals, its progress and errors as JSON lines on
// standard error.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "engine/comm/communicator.h"
#include "storage/base/error.h"
#include "storage/base/job_context.h"

namespace footwall::app {

// From now on SIGINT, SIGTERM, SIGUSR1 and SIGUSR2 do not end the program, but cancel its job, also one that
// has not begun. Call it before MPI_Init, which takes a while.
void heed_signals();

// The job, which signals cancel from now on. On rank 0 it prints its progress on standard error, as JSON
// lines
// {"progress": {fraction, phase, amounts}}. Call it once.
const JobContext& running_job(const comm::Communicator& world);

// Whether this rank got SIGTERM or SIGUSR1: how batch systems ask for their processors, before they kill.
bool told_to_make_room();

// One line on standard error, in one write. Nobody may be listening any more: that is no error.
void print_line(const nlohmann::json& json);
// One line {"error": {code, message, hint}} on standard error.
void print_error(const Error& error);

}  // namespace footwall::app
