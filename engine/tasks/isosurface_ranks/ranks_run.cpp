#include "engine/tasks/isosurface_ranks/ranks_run.h"

#include <fmt/format.h>

#include "engine/session/private_folder.h"
#include "storage/base/text.h"

namespace footwall::tasks {

std::vector<std::string> engine_words(const RanksRun& run, const std::filesystem::path& result) {
  std::string ways;
  for (const isosurface::Interleaving& way : run.interleavings)
    ways += fmt::format("{}{}", ways.empty() ? "" : ",", isosurface::text_of(way));
  std::vector<std::string> words{"bench-isosurface", std::filesystem::absolute(run.raw).string(), "--size",
                                 fmt::format("{}x{}x{}", run.size[0], run.size[1], run.size[2]),
                                 // One word: a negative value is no option.
                                 fmt::format("--value={}", text::shortest(run.value)), "--variant",
                                 run.variant, "--pillars", ways, "--repeat", std::to_string(run.repeats),
                                 "--threads", std::to_string(run.threads), "--result", result.string()};
  if (!run.normals) words.emplace_back("--no-normals");
  if (run.pyramid) words.emplace_back("--pyramid");
  return words;
}

std::string bench_isosurface_ranks(const RanksRun& run, const session::LaunchOptions& launch,
                                   const JobContext& job) {
  const session::PrivateFolder folder(session::temporary_home());
  const std::filesystem::path result = folder.path() / "result.json";
  return session::run_engine(launch, {engine_words(run, result), result}, job);
}

}  // namespace footwall::tasks
