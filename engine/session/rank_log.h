// What each rank of a batch job did: where it ran, how long its phases took, how much memory it needed. For
// result.json, and as lines of text beside it, to which every run of the job adds.
#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "engine/comm/communicator.h"
#include "engine/extract/face.h"

namespace footwall::session {

// Of one rank.
struct RankPhases {
  extract::Seconds seconds;  // of all groups of faults, its own; wait is part of the exchange
  double write = 0;          // part files and whole faults
  double total = 0;
};

// On rank 0, [{rank, host, process, threads, seconds{read, balance, voxelize, exchange, wait, compute, write,
// total}, peak_memory_bytes}], by rank; null elsewhere. Peak memory is that of the process so far.
// Collective.
nlohmann::json rank_log(const comm::Communicator& world, const RankPhases& mine, int threads);

// Adds a line that says what became of the run, and one for each rank, to the file. Throws Error kIo.
void append_rank_log(const std::filesystem::path& path, const std::string& outcome,
                     const nlohmann::json& ranks);

}  // namespace footwall::session
