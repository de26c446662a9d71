// footwall extract: EXTRACT-ALL on the engine, the result attached to the project.
#include <fmt/format.h>
#include <cmath>
#include <memory>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/options.h"
#include "engine/extract/registry.h"
#include "engine/tasks/extract_run.h"
#include "storage/base/text.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project, compute;
  std::optional<int> ranks;
  tasks::ExtractOptions how;
};

// More ranks than this on one machine are a slip of the pen, which mpirun takes minutes to fail at.
constexpr int kMostRanks = 1024;

void check_counts(Options& options) {
  if (options.ranks.value_or(1) < 1 || options.ranks.value_or(1) > kMostRanks) {
    throw Error(ErrorCode::kUsage, fmt::format("there cannot be {} ranks", *options.ranks),
                fmt::format("give 1 to {}, or leave --ranks out for the machine's own", kMostRanks));
  }
  options.how.launch.ranks = options.ranks.value_or(0);
  if (options.how.launch.threads < 1) {
    throw Error(ErrorCode::kUsage, "--threads must be at least 1", "leave it out for one");
  }
  if (options.how.velocity && !(*options.how.velocity > 0 && std::isfinite(*options.how.velocity))) {
    throw Error(ErrorCode::kUsage, fmt::format("--velocity {} is no velocity", *options.how.velocity),
                "give a number above 0, in m/s");
  }
}

console::Output run(Options& options, const console::Console& console) {
  for (const std::string_view name : text::split(options.compute, ',')) {
    if (!name.empty()) options.how.engine.compute.emplace_back(name);
  }
  check_counts(options);
  project::Project project = open_project(options.project, project::OpenMode::kWrite);
  const tasks::Extracted done = tasks::extract_run(project, options.how, console.job());
  project.close();

  const console::Json result = console::Json::parse(done.result_json);
  console::Output output;
  output.json = {{"run", done.run}, {"volume", done.volume}};
  for (const char* key : {"faces", "voxels", "ranks", "threads", "exchange", "balance", "voxelizer",
                          "seconds", "bytes_sent", "messages", "load_max_over_mean", "checksum"}) {
    output.json[key] = result.at(key);
  }
  output.json["triangulated"] = done.triangulated;
  output.json["skipped"] = done.skipped;
  output.text =
      fmt::format("run {}: {} faces, {} voxels of volume {} on {} ranks in {:.2f} s; checksum {}\n", done.run,
                  result.at("faces").get<std::int64_t>(), result.at("voxels").get<std::int64_t>(),
                  done.volume, result.at("ranks").get<int>(), result.at("seconds").at("total").get<double>(),
                  result.at("checksum").get<std::string>());
  return output;
}

std::string names(std::span<const extract::Row> rows) {
  std::string text;
  for (const extract::Row& row : rows) {
    if (row.built) text += (text.empty() ? "" : ", ") + std::string(row.name);
  }
  return text;
}

}  // namespace

void add_extract(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add(nullptr, "extract", "EXTRACT-ALL: statistics of the voxels that each face cuts",
                  [options](console::Console& console) { return run(*options, console); });
  tasks::ExtractOptions& how = options->how;
  command->add_option("project", options->project, "The project, NAME.footwall")->required();
  command->add_option("--volume", how.volume, "The volume (default: the first)");
  command->add_option("--fault", how.fault, "Only this fault (default: all)");
  command->add_option("--name", how.name, "Name of the run (default: run N)");
  command->add_option("--ranks", options->ranks,
                      "MPI ranks (default: the smaller of 4 and the usable cores)");
  command->add_option("--threads", how.launch.threads, "Threads of each rank (default 1)");
  command->add_option(
      "--exchange", how.engine.exchange,
      "How values reach a face's rank: " + names(extract::exchange_rows()) + " (default auto)");
  command->add_option(
      "--balance", how.engine.balance,
      "How faces are spread over ranks: " + names(extract::balance_rows()) + " (default none)");
  command->add_option("--voxelizer", how.engine.voxelizer,
                      "Which voxels a face cuts: " + names(extract::voxelizer_rows()) + " (default exact)");
  command->add_option("--compute", options->compute,
                      "Statistics, comma separated: " + names(extract::statistic_rows()) + " (default: all)");
  command->add_option("--velocity", how.velocity,
                      "m/s: gives area and dip in metres and degrees in a time survey");
}

}  // namespace footwall::commands
