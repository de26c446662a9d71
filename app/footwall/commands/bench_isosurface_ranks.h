// footwall bench isosurface --ranks: many ways to cut a volume into pillars, as in figure 2 of seed 000.
#pragma once
#include <optional>
#include <string>

#include "app/footwall/console/program.h"
#include "engine/tasks/bench_isosurface.h"

namespace footwall::commands {

struct RanksOptions {
  std::optional<int> ranks;
  std::string pillars, interleave;

  void add_to(CLI::App& command);
  bool given() const { return ranks.has_value() || !pillars.empty() || !interleave.empty(); }
  // how: what `bench isosurface` was told otherwise; without a volume it is that of central_volume(). Throws
  // kUsage and what the engine throws.
  console::Output run(const tasks::BenchIsosurfaceOptions& how, const JobContext& job) const;
};

}  // namespace footwall::commands
