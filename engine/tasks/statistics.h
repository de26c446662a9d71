// The statistics that a run stores, as the project's `statistic` table lists them, and how a part file's
// columns become them.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "engine/session/part_file.h"
#include "storage/project/project.h"

namespace footwall::tasks {

// In the order in which CSV and VTP print them.
std::vector<project::StatisticRecord> stored_statistics();
// These, and behind them what else the project has registered: statistics that were set by hand.
std::vector<project::StatisticRecord> known_statistics(const project::Project& project);
// One vector per statistic, one entry per face; NaN = undefined.
std::map<std::string, std::vector<double>> columns_of(const session::Part& part);

// The unit in words: "amplitude^2" of a statistic, "" where there is none.
std::string unit_of(const project::StatisticRecord& statistic);

}  // namespace footwall::tasks
