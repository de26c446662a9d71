// The picture of a project's faults, coloured by a statistic of a run, with sections of a volume.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "storage/base/job_context.h"
#include "storage/project/project.h"

namespace footwall::tasks {

struct RenderOptions {
  bool faults = true;
  std::vector<std::string>
      sections;        // "inline=N", "crossline=N", "z=VALUE"; N may be "first", "middle" or "last"
  std::string volume;  // for sections; empty: the first
  std::string statistic = "variance";
  std::string colours;  // empty: the statistic's own colour map
  std::optional<std::array<double, 2>> range;
  std::optional<std::int64_t> run;
  int width = 1600;
  int height = 1000;
  std::optional<double> azimuth;  // none: chosen
  double elevation = 25;
  double zoom = 1;
  double exaggeration = 0;  // 0: chosen
  double velocity = 0;      // m/s; 0: 1 ms is drawn as 1 m
  int threads = 0;
};

struct Rendered {
  std::int64_t faces = 0;
  std::vector<std::string> notices;  // stale or never computed colours
};

// Throws kUsage for options that make no sense, kInvalid for a line that the survey does not have.
Rendered render_faults(const project::Project& project, const RenderOptions& options,
                       const std::filesystem::path& out, const JobContext& job);

}  // namespace footwall::tasks
