// The seed's tables of its benchmarks, ours with its figures beside them.
#pragma once
#include <vector>

#include "engine/tasks/bench_extract/results.h"
#include "engine/tasks/bench_extract/table.h"

namespace footwall::tasks {

// For each benchmark: F.1 to F.3 (seconds), 5.1 to 5.3 (speedup over the best serial run; ours with the
// efficiency), seconds per repeat of the slowest and the quickest rank, phases and amounts; and F.4 (load
// deviation) for benchmark 2. "[x]" is the seed's figure, where it has one.
std::vector<Table> benchmark_tables(const BenchResult& result);

}  // namespace footwall::tasks
