// What a picture cost, over all ranks.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "engine/comm/communicator.h"
#include "engine/render/composite/compose.h"

namespace footwall::session {

// {ranks, bytes_sent, messages, merged_bytes, merged_pixels, seconds{read, extract, group, project,
// rasterize, shade, merge, gather}}: amounts are sums over ranks, seconds those of the slowest rank in each
// phase. read_seconds, extract_seconds: of this rank. Collective.
nlohmann::json picture_costs(const comm::Communicator& world, double read_seconds, double extract_seconds,
                             const render::ComposeReport& report);

}  // namespace footwall::session
