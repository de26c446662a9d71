// footwall workload run: runs a script on the engine and tells what it took.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/footwall/commands/launch_options.h"
#include "app/footwall/commands/workload.h"
#include "engine/extract/registry.h"
#include "engine/tasks/workload/run.h"
#include "storage/base/text.h"

namespace footwall::commands {
namespace {

constexpr double kMegabyte = 1e6;

struct Options {
  EngineOptions engine;
  std::string compute, interleave = "1x1";
  double memory = 1024;  // MiB
  tasks::WorkloadRunOptions how;
};

std::string names(std::span<const extract::Row> rows) {
  std::string text;
  for (const extract::Row& row : rows) {
    if (row.built) text += (text.empty() ? "" : ", ") + std::string(row.name);
  }
  return text;
}

std::array<int, 2> pillars_from(const std::string& text) {
  constexpr std::int64_t kMost = 1024;
  const auto parts = text::split(text, 'x');
  const auto a = parts.size() == 2 ? text::integer(parts[0]) : std::nullopt;
  const auto b = parts.size() == 2 ? text::integer(parts[1]) : std::nullopt;
  if (!a || !b || *a < 1 || *b < 1 || *a > kMost || *b > kMost) {
    throw Error(ErrorCode::kUsage, fmt::format("--interleave {} is no number of pillars", text),
                "give each rank's pillars along inlines x along crosslines, as 2x2");
  }
  return {static_cast<int>(*a), static_cast<int>(*b)};
}

void check(Options& options) {
  options.how.launch = options.engine.launch();
  extract::Options& engine = options.how.options;
  engine.pillars = pillars_from(options.interleave);
  constexpr double kMiB = 1 << 20;
  constexpr double kMostMiB = 1 << 24;
  if (!(options.memory >= 0 && options.memory <= kMostMiB)) {
    throw Error(ErrorCode::kUsage, fmt::format("--memory {} cannot be", options.memory),
                "give the MiB of voxels that each rank may keep of other ranks' parts");
  }
  engine.cache_bytes = static_cast<std::int64_t>(options.memory * kMiB);
  for (const std::string_view name : text::split(options.compute, ',')) {
    if (!name.empty()) engine.compute.emplace_back(name);
  }
  if (engine.snr != 0 &&
      std::find(engine.compute.begin(), engine.compute.end(), "lot") == engine.compute.end())
    throw Error(ErrorCode::kUsage, "--snr is about --compute lot", "add lot to --compute");
}

// As the seed's program prints it (appendix B.1.2), with the phases below.
std::string in_words(const console::Json& r) {
  const console::Json& operations = r.at("operations");
  const double repeats = static_cast<double>(std::max<std::size_t>(1, r.at("repeats").size()));
  const auto number = [&](const char* key) { return r.at(key).get<double>(); };
  std::string text = fmt::format(
      "{} ranks of {} threads; exchange {}, balance {}, voxelizer {}\n\n"
      "Benchmark results\n-----------------\n",
      r.at("ranks").get<int>(), r.at("threads").get<int>(), r.at("exchange").get<std::string>(),
      r.at("balance").get<std::string>(), r.at("voxelizer").get<std::string>());
  const auto line = [&](const char* what, const std::string& value) {
    text += fmt::format("--- {:.<38}: {}\n", what, value);
  };
  const auto count = [&](const char* key) { return std::to_string(operations.at(key).get<std::int64_t>()); };
  const auto took = [&](const char* key) {
    return fmt::format("{:.6f} Per Repeat: {:.6f}", number(key), number(key) / repeats);
  };
  line("Add operations", count("adds"));
  line("Remove operations", count("removes"));
  line("Move operations", count("moves"));
  line("Extract-All/compute operations", count("extracts"));
  line("Slowest node took", took("slowest_rank"));
  line("Quickest node took", took("quickest_rank"));
  line("Average load StDev over all cycles", fmt::format("{:.6f}", number("load_deviation")));
  const console::Json& seconds = r.at("seconds");
  text += "\nseconds   ";
  for (const char* phase : {"apply", "balance", "voxelize", "exchange", "compute", "total"})
    text += fmt::format(" {} {:.4f}", phase, seconds.at(phase).get<double>());
  text += fmt::format(
      "\n{} faces, {} voxels extracted; {:.3f} MB in {} messages, {} voxels from the cache; load max/mean "
      "{:.3f}\nchecksum {}\n",
      r.at("faces").get<std::int64_t>(), r.at("voxels").get<std::int64_t>(), number("bytes_sent") / kMegabyte,
      r.at("messages").get<std::int64_t>(), r.at("cache_hits").get<std::int64_t>(),
      number("load_max_over_mean"), r.at("checksum").get<std::string>());
  return text;
}

console::Output run(Options& options, const console::Console& console) {
  check(options);
  console::Output output;
  output.json = console::Json::parse(tasks::run_workload_engine(options.how, console.job()));
  output.text = in_words(output.json);
  return output;
}

}  // namespace

void add_workload_run(console::Program& program, CLI::App* group) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add(group, "run", "Run a script on the engine and tell what it took",
                                  [options](console::Console& console) { return run(*options, console); });
  extract::Options& engine = options->how.options;
  command->add_option("file", options->how.script, "The script")->required();
  options->engine.add_to(*command);
  command->add_option(
      "--exchange", engine.exchange,
      "How values reach a face's rank: " + names(extract::exchange_rows()) + " (default auto)");
  command->add_option(
      "--balance", engine.balance,
      "How faces are spread over ranks: " + names(extract::balance_rows()) + " (default auto)");
  command->add_option("--voxelizer", engine.voxelizer,
                      "Which voxels a face cuts: " + names(extract::voxelizer_rows()) + " (default exact)");
  command->add_option("--compute", options->compute,
                      "Comma separated: " + names(extract::statistic_rows()) + " (default: the statistics)");
  command->add_option("--snr", engine.snr, "For lot: signal-to-noise ratio in dB");
  command->add_option("--interleave", options->interleave,
                      "Pillars of each rank along inlines x crosslines (default 1x1)");
  command->add_option("--memory", options->memory,
                      "MiB of other ranks' voxels that a rank may keep (default 1024)");
  command->add_option("--seed", options->how.seed, "Another seed gives other voxel values (default 1)");
  command->add_flag("--keep-cache", options->how.keep_cache,
                    "Keep other ranks' voxels from one repeat to the next (default: within a repeat)");
  command->add_flag("--phases-apart", engine.phases_apart,
                    "For measuring: tell the waiting for slower ranks apart from the exchange");
}

}  // namespace footwall::commands
