// Brings a fresh engine to where a project is: its volumes opened, its faults the model.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "engine/service/client/engine_client.h"
#include "storage/base/job_context.h"
#include "storage/project/project.h"

namespace footwall::tasks {

struct Replayed {
  std::vector<std::string> volumes;  // names of those that are open
  std::int64_t faces = 0;
  std::vector<std::string> notices;  // what was left out, and why
};

// The model is replaced as a whole. A volume that cannot be opened and a fault that cannot be made a surface
// are noted. The project is only read. Throws kEngine, kCancelled, and what the engine says of the model.
Replayed replay_project(project::Project& project, service::EngineClient& engine, const JobContext& job);

}  // namespace footwall::tasks
