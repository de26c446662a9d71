// How long pictures of isosurfaces and meshes take on all ranks: `footwall bench render`.
#pragma once
#include <string>

#include "engine/session/launch.h"
#include "engine/session/render_bench.h"
#include "storage/base/job_context.h"

namespace footwall::tasks {

// The text of the engine's result, see session::RenderBench::result; bench.result is chosen here, threads are
// those of the launch. Throws kUsage for numbers that cannot be, and what the engine throws.
std::string bench_render(session::RenderBench bench, const session::LaunchOptions& launch,
                         const JobContext& job);

}  // namespace footwall::tasks
