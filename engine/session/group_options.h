// How ranks that draw decide who shares geometry with whom, on this machine.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "engine/comm/communicator.h"
#include "engine/render/composite/groups.h"

namespace footwall::session {

// threshold: as in groups.h; none: by estimated times, with the links that extract's cost model measured here
// and kept (extract/machine_rates.h; 0.3 s where there are none yet) and drawing as it is measured now. A
// rank may hold a quarter of its share of what memory its host has left, as geometry that arrives is there
// twice and is projected. Collective; throws kMemory, kEngine.
render::GroupOptions group_options(const comm::Communicator& world, std::optional<double> threshold,
                                   int threads);

// In jobs' files: a number, or "auto" for none.
nlohmann::json json_of_threshold(std::optional<double> threshold);
std::optional<double> threshold_from(const nlohmann::json& json);

}  // namespace footwall::session
