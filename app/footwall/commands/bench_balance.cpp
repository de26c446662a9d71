// footwall bench balance: load balancing on any number of ranks, replayed on one core.
#include "engine/tasks/bench_balance.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "app/footwall/commands/bench_balance.h"
#include "app/footwall/commands/options.h"
#include "storage/base/text.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string project, workload, size, ranks, strategies, pillars, deltas, taus;
  bool sweep = false;
  tasks::RandomFaces shape;
  tasks::BenchBalanceOptions how;
};

[[noreturn]] void refuse(std::string_view option, std::string_view text, const char* hint) {
  throw Error(ErrorCode::kUsage, fmt::format("'{}' is nothing for {}", text, option), hint);
}

std::vector<double> numbers_from(const std::string& list, std::string_view option, const char* hint) {
  std::vector<double> numbers;
  for (const std::string_view part : text::split(list, ',')) {
    const auto number = text::number(part);
    if (!number || !std::isfinite(*number)) refuse(option, part, hint);
    numbers.push_back(*number);
  }
  return numbers;
}

std::vector<int> whole_from(const std::string& list, std::string_view option, const char* hint) {
  std::vector<int> whole;
  for (const double number : numbers_from(list, option, hint)) {
    if (number != std::floor(number) || number < 1 || number > 1e6) refuse(option, list, hint);
    whole.push_back(static_cast<int>(number));
  }
  return whole;
}

// "none;local=0,cache": parameters have commas already.
std::vector<std::string> strategies_from(const std::string& list) {
  std::vector<std::string> names;
  for (const std::string_view part : text::split(list, ';')) names.emplace_back(text::trimmed(part));
  return names;
}

std::vector<std::array<int, 2>> pillars_from(const std::string& list) {
  const char* hint = "write 1x1 or 1x1,2x2";
  std::vector<std::array<int, 2>> pillars;
  for (const std::string_view part : text::split(list, ',')) {
    const std::size_t cross = part.find('x');
    if (cross == std::string_view::npos) refuse("--pillars", part, hint);
    pillars.push_back({whole_from(std::string(part.substr(0, cross)), "--pillars", hint).front(),
                       whole_from(std::string(part.substr(cross + 1)), "--pillars", hint).front()});
  }
  return pillars;
}

void read(Options& options) {
  const int sources =
      (options.project.empty() ? 0 : 1) + (options.workload.empty() ? 0 : 1) + (options.size.empty() ? 0 : 1);
  if (sources != 1) {
    throw Error(ErrorCode::kUsage, "it is not clear whose faces are meant",
                "give one of PROJECT, --workload FILE and --size IxJxK");
  }
  if (!options.size.empty()) options.shape.size = dims_from(options.size, "--size");
  if (options.sweep) {
    options.how.deltas = {0, 1, 4, 16};
    options.how.taus.clear();
    options.how.pillars = {{1, 1}, {2, 2}, {4, 4}};
  }
  if (!options.ranks.empty()) options.how.ranks = whole_from(options.ranks, "--ranks", "write 4 or 1,2,4,8");
  if (!options.strategies.empty()) options.how.strategies = strategies_from(options.strategies);
  if (!options.pillars.empty()) options.how.pillars = pillars_from(options.pillars);
  if (!options.deltas.empty())
    options.how.deltas = numbers_from(options.deltas, "--delta", "write 0 or 0,1,4, in mean face areas");
  if (options.taus == "all") {
    options.how.taus.clear();
  } else if (!options.taus.empty()) {
    options.how.taus = whole_from(options.taus, "--tau", "write all, 2 or 1,2,3");
  }
}

tasks::Extractions extractions(const Options& options, const JobContext& job) {
  if (!options.workload.empty()) return tasks::extractions_of_script(options.workload);
  if (!options.size.empty()) return tasks::extractions_of(options.shape, job);
  project::Project project = open_project(options.project, project::OpenMode::kRead);
  return tasks::extractions_of_project(project, job);
}

console::Json row_json(const tasks::BalanceRow& row) {
  return {
      {"ranks", row.ranks},
      {"pillars", row.pillars},
      {"balance", row.strategy},
      {"load_deviation", row.deviation},
      {"published_load_deviation", row.published ? console::Json(*row.published) : console::Json(nullptr)},
      {"area_max_over_mean", row.area_max_over_mean},
      {"load_max_over_mean", row.voxels_max_over_mean},
      {"remote_voxels", row.remote_voxels},
      {"bytes_sent", row.sent_bytes},
      {"moved_faces", row.moved_faces},
      {"predicted",
       {{"compute", row.compute_seconds}, {"exchange", row.exchange_seconds}, {"total", row.seconds()}}},
      {"decision_seconds", row.decision_seconds}};
}

console::Output bench_balance(Options& options, const console::Console& console) {
  read(options);
  const tasks::BenchBalanceResult done =
      tasks::bench_balance(extractions(options, console.job()), options.how, console.job());
  console::Output output;
  output.json = {
      {"dims", done.dims},           {"faces", done.faces},           {"extractions", done.extractions},
      {"mean_area", done.mean_area}, {"voxels", done.mean_voxels},    {"exchange", options.how.exchange},
      {"checked", done.checked},     {"rows", console::Json::array()}};
  output.text = fmt::format(
      "{} faces of mean area {:.0f} voxel^2 in {}x{}x{}, {} EXTRACT-ALL, {:.2f} M voxels each\n", done.faces,
      done.mean_area, done.dims[0], done.dims[1], done.dims[2], done.extractions, done.mean_voxels / 1e6);
  output.text += fmt::format("{:>5} {:>7} {:<22} {:>11} {:>11} {:>8} {:>9} {:>9} {:>9} {:>11} {:>11}\n",
                             "ranks", "pillars", "balance", "deviation", "seed's", "max/mean", "remote M",
                             "moved", "sent MB", "predict ms", "decide ms");
  for (const tasks::BalanceRow& row : done.rows) {
    output.json["rows"].push_back(row_json(row));
    output.text += fmt::format(
        "{:>5} {:>7} {:<22} {:>11.0f} {:>11} {:>8.3f} {:>9.3f} {:>9.0f} {:>9.2f} {:>11.3f} {:>11.3f}\n",
        row.ranks, fmt::format("{}x{}", row.pillars[0], row.pillars[1]), row.strategy, row.deviation,
        row.published ? fmt::format("{:.0f}", *row.published) : "", row.voxels_max_over_mean,
        row.remote_voxels / 1e6, row.moved_faces, row.sent_bytes / 1e6, row.seconds() * 1e3,
        row.decision_seconds * 1e3);
  }
  output.text += fmt::format(
      "deviation: of the ranks' areas, voxel^2; max/mean: of their voxels; remote, sent and predicted time "
      "with "
      "exchange {}\n{} decisions were compared with the pseudocode first, all sums checked\n",
      options.how.exchange, done.checked);
  return output;
}

}  // namespace

void add_bench_balance(console::Program& program, CLI::App* bench) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add(bench, "balance", "Load balancing on many ranks, replayed on one core",
                  [options](console::Console& console) { return bench_balance(*options, console); });
  command->add_option("project", options->project, "Whose faults' faces are shared out");
  command->add_option("--workload", options->workload, "Instead: the EXTRACT-ALLs of a workload script");
  command->add_option("--size", options->size, "Instead: random meshes in a survey of IxJxK voxels");
  command->add_option("--area", options->shape.area, "Their mean face area in voxel^2 (default 1000)");
  command->add_option("--faces", options->shape.faces, "How many faces they have (default 10000)");
  command->add_option("--cycles", options->shape.cycles,
                      "EXTRACT-ALLs, all vertices move by 10 voxels in between (default 1)");
  command->add_option("--seed", options->shape.seed, "Of the random numbers (default 1)");
  command->add_option("--ranks", options->ranks, "Rank counts, with commas (default 1,2,4,...,256)");
  command->add_option("--strategy", options->strategies,
                      "As extract takes them, also local=D,running; several with ';' (default all)");
  command->add_option("--delta", options->deltas,
                      "Thresholds in mean face areas, with commas, where no strategy is named (default 0)");
  command->add_option("--tau", options->taus,
                      "Distances of manhattan beside the infinite one, with commas, or all (default 2)");
  command->add_option("--pillars", options->pillars, "Pillars of a rank: 1x1,2x2,4x4 (default 1x1)");
  command->add_option(
      "--exchange", options->how.exchange,
      "Whose bytes and time are predicted: minimum, block=B, bounding, push (default), reduce");
  command->add_flag("--sweep", options->sweep, "Thresholds 0,1,4,16, all distances, pillars 1x1,2x2,4x4");
}

}  // namespace footwall::commands
