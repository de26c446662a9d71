// Whether the numbers that a client gathered move by move are right, before any time counts.
#pragma once
#include <filesystem>

#include "engine/session/launch.h"
#include "engine/tasks/detail/bench_service_live_moves.h"

namespace footwall::tasks {

// Against a fresh engine of one rank, which is given the model as it stands and extracts all of it, to the
// bit; and some faces against the definitions (engine/verify). Throws Error kInternal that names the face and
// both numbers.
void check_numbers(const LiveMoves& moves, const std::filesystem::path& volume,
                   const session::LaunchOptions& launch, const JobContext& job);

}  // namespace footwall::tasks
