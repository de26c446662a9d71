// What an engine tells of itself, as plain values: filled on the ranks, asked by the server.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "storage/survey/box.h"

namespace footwall::service {

struct RankFacts {
  std::string host;
  int process = 0;
  std::int64_t memory_bytes = 0;  // resident, as of the last command
  // From rank 0's ring to this rank's waking for the last command; none on other hosts, whose clocks differ.
  std::optional<double> start_seconds = std::nullopt;
};

struct VolumeFacts {
  std::string checksum;  // 16 hex digits: its name in requests
  std::string path;
  survey::Index dims{0, 0, 0};
  std::int64_t memory_bytes = 0;  // of all ranks
};

struct ResidentStatus {
  int threads = 1;  // of each rank
  std::vector<RankFacts> ranks;
  std::vector<VolumeFacts> volumes;
  std::int64_t faces = 0;
  std::uint64_t edit = 0;        // the newest applied
  std::uint64_t state_hash = 0;  // of model and volumes
};

}  // namespace footwall::service
