// What `info` and `faults` tell about a project.
#pragma once
#include <nlohmann/json.hpp>

#include "storage/base/job_context.h"
#include "storage/project/project.h"

namespace footwall::tasks {

// The object of `info PROJECT --json` (docs/commands.md). verify: reads every volume whole and checks its
// hashes and the database's integrity; throws kCorrupt naming what is damaged.
nlohmann::ordered_json project_facts(const project::Project& project, bool verify, const JobContext& job);

// The object of `faults PROJECT --json`: faults, pillars, nodes, with line numbers where there is a survey.
nlohmann::ordered_json fault_list(const project::Project& project, const std::string& fault);

}  // namespace footwall::tasks
