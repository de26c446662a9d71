// The checks that start the engine.
#pragma once
#include <filesystem>
#include <optional>

#include "engine/session/self_check.h"
#include "engine/tasks/doctor/finding.h"

namespace footwall::tasks {

// Three rows: do two ranks work together, do their MPI libraries agree, can they write one HDF5 file in
// `folder`. Where the ranks do not start the other two are left out. What the ranks told; nothing where they
// did not start.
std::optional<session::EngineFacts> check_engine_rows(Checkup& checkup, const session::LaunchOptions& launch,
                                                      const std::filesystem::path& folder);

// What the answers mean.
Finding ranks_finding(const session::EngineFacts& facts, int ranks, double seconds);
Finding mpi_finding(const session::EngineFacts& facts);
Finding hdf5_finding(const session::EngineFacts& facts);

}  // namespace footwall::tasks
