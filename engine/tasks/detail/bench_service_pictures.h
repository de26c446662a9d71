// Pictures of an isosurface of a volume that an engine holds, each from another side.
#pragma once
#include <string>
#include <vector>

#include "engine/service/client/engine_client.h"
#include "storage/base/job_context.h"

namespace footwall::tasks {

// From the call to the last tile, of 1024 x 1024 pixels, from the n-th side; `tiles` gets their bytes. Throws
// Error kInternal where nothing is seen.
double draw_side(service::EngineClient& client, const std::string& volume, float value, int side,
                 std::string& tiles, const JobContext& job);

}  // namespace footwall::tasks
