// footwall bench extract: the seed's benchmarks, with its figures beside ours.
#include "app/footwall/commands/bench_extract.h"

#include <fmt/format.h>

#include <memory>

#include "app/footwall/commands/launch_options.h"
#include "engine/tasks/bench_extract/bench_extract.h"
#include "engine/tasks/bench_extract/compare.h"
#include "engine/tasks/bench_extract/tables.h"
#include "storage/base/cores.h"
#include "storage/base/partial_file.h"
#include "storage/base/text.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string benchmarks = "1,2,3", ranks = "1,2,4,8", exchange, balance, compute = "variance", file;
  std::optional<int> threads;
  bool markdown = false;
  tasks::BenchExtractOptions how;
};

std::vector<int> numbers_in(const std::string& list, const char* option) {
  std::vector<int> numbers;
  for (const std::string_view word : text::split(list, ',')) {
    constexpr std::int64_t kMost = 1 << 20;
    const auto number = text::integer(word);
    if (!number || *number < 1 || *number > kMost) {
      throw Error(ErrorCode::kUsage, fmt::format("{} {} is no list of numbers", option, list),
                  "give whole numbers above 0 with commas between them");
    }
    numbers.push_back(static_cast<int>(*number));
  }
  return numbers;
}

// Names with commas between them; a word that is a number belongs to the name before it ("manhattan=0,2").
std::vector<std::string> names_in(const std::string& list) {
  std::vector<std::string> names;
  for (const std::string_view word : text::split(list, ',')) {
    if (word.empty()) continue;
    const bool parameter = text::number(word).has_value() || word == "cache";
    if (parameter && !names.empty()) {
      names.back() += "," + std::string(word);
    } else {
      names.emplace_back(word);
    }
  }
  return names;
}

console::Json json_of(const tasks::BenchCell& cell, const tasks::BenchResult& result) {
  using tasks::BenchRun;
  const tasks::BenchCell* serial = result.serial(cell.benchmark);
  const double seconds = cell.median(&BenchRun::slowest_rank);
  const auto median = [&](double BenchRun::*of) { return cell.median(of); };
  const auto apart = [&](double BenchRun::*of) { return cell.median_apart(of); };
  console::Json json{{"benchmark", cell.benchmark},
                     {"ranks", cell.ranks},
                     {"exchange", cell.pair.exchange},
                     {"balance", cell.pair.balance},
                     {"runs", cell.runs.size()},
                     {"slowest_rank", seconds},
                     {"slowest_rank_min", cell.least(&BenchRun::slowest_rank)},
                     {"slowest_rank_max", cell.most(&BenchRun::slowest_rank)},
                     {"quickest_rank", median(&BenchRun::quickest_rank)},
                     {"seconds",
                      {{"apply", median(&BenchRun::apply)},
                       {"balance", median(&BenchRun::balance)},
                       {"voxelize", median(&BenchRun::voxelize)},
                       {"exchange", median(&BenchRun::exchange)},
                       {"compute", median(&BenchRun::compute)}}},
                     {"seconds_apart",
                      {{"balance", apart(&BenchRun::balance)},
                       {"voxelize", apart(&BenchRun::voxelize)},
                       {"exchange", apart(&BenchRun::exchange)},
                       {"compute", apart(&BenchRun::compute)},
                       {"wait", apart(&BenchRun::wait)}}},
                     {"bytes_sent", median(&BenchRun::bytes)},
                     {"messages", median(&BenchRun::messages)},
                     {"cache_hits", median(&BenchRun::cache_hits)},
                     {"load_deviation", median(&BenchRun::load_deviation)},
                     {"load_max_over_mean", median(&BenchRun::load_max_over_mean)},
                     {"checksum", cell.runs.front().checksum},
                     {"speedup", nullptr},
                     {"efficiency", nullptr},
                     {"exchange_model", nullptr}};
  if (serial != nullptr) {
    json["speedup"] = serial->median(&BenchRun::slowest_rank) / seconds;
    json["efficiency"] = serial->median(&BenchRun::slowest_rank) / seconds / cell.ranks;
  }
  if (const auto model = tasks::exchange_model(result, cell)) json["exchange_model"] = *model;
  return json;
}

console::Json json_of(const tasks::BenchResult& result, const Options& options) {
  console::Json json{{"extracts", result.extracts},
                     {"repeats", result.repeats},
                     {"compute", options.how.compute},
                     {"scale", options.how.scale},
                     {"cores", usable_cores()},
                     {"cells", console::Json::array()},
                     {"auto_against_seed", console::Json::array()},
                     {"rates", console::Json::array()}};
  for (const tasks::BenchCell& cell : result.cells) json["cells"].push_back(json_of(cell, result));
  for (const tasks::AutoAgainstSeed& one : tasks::auto_against_seed(result)) {
    json["auto_against_seed"].push_back({{"benchmark", one.benchmark},
                                         {"ranks", one.ranks},
                                         {"exchange", one.fastest.exchange},
                                         {"balance", one.fastest.balance},
                                         {"seconds", one.seconds},
                                         {"auto_seconds", one.auto_seconds},
                                         {"time_ratio", one.time_ratio},
                                         {"exchange_ratio", one.exchange_ratio},
                                         {"waiting_exchange_ratio", one.waiting_exchange_ratio}});
  }
  for (const extract::MachineRates& rates : result.rates)
    json["rates"].push_back(console::Json::parse(extract::to_text(rates)));
  return json;
}

console::Output run(Options& options, const console::Console& console) {
  tasks::BenchExtractOptions& how = options.how;
  how.benchmarks = numbers_in(options.benchmarks, "--benchmarks");
  how.ranks = numbers_in(options.ranks, "--ranks");
  how.exchanges = names_in(options.exchange);
  how.balances = names_in(options.balance);
  how.compute = names_in(options.compute);
  how.launch.threads = options.threads.value_or(1);
  const tasks::BenchResult result = tasks::bench_extract(how, tasks::real_engine(how.launch), console.job());
  console::Output output{json_of(result, options), ""};
  output.text = fmt::format(
      "{} cores; {} EXTRACT-ALLs in {} repeats with 16 meshes each; {}; {} runs of each; all results "
      "agree\n\n",
      usable_cores(), result.extracts, result.repeats, fmt::join(how.compute, ", "), how.repeat);
  std::vector<tasks::Table> tables = tasks::benchmark_tables(result);
  for (tasks::Table& table : tasks::comparison_tables(result)) tables.push_back(std::move(table));
  for (const tasks::Table& table : tables)
    output.text += options.markdown ? tasks::to_markdown(table) : tasks::to_text(table);
  if (!options.file.empty()) write_whole_file(options.file, output.json.dump(1) + "\n");
  return output;
}

}  // namespace

void add_bench_extract(console::Program& program, CLI::App* group) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add(group, "extract", "The seed's benchmarks over strategies, balancers and ranks",
                  [options](console::Console& console) { return run(*options, console); });
  command->add_option("--benchmarks", options->benchmarks, "Of 1, 2, 3 (default: all)");
  command->add_option("--ranks", options->ranks, "Numbers of ranks (default 1,2,4,8)");
  command->add_option("--threads", options->threads, "Threads of each rank (default 1)");
  command->add_option("--exchange", options->exchange,
                      "Exchanges (default minimum,block=2,bounding,push,reduce); auto always runs, too");
  command->add_option("--balance", options->balance,
                      "Balancers (default none,global=0,local=0,manhattan=0,manhattan=0,2,minimal)");
  command->add_option("--compute", options->compute, "As of extract, e.g. variance,lot (default variance)");
  command->add_option("--snr", options->how.snr, "For lot: signal-to-noise ratio in dB (default 40)");
  command->add_option("--repeat", options->how.repeat, "Runs of each; medians count (default 1)");
  command->add_option("--apart", options->how.apart,
                      "So many runs of each on several ranks once more, with phases apart (default 1)");
  command->add_option("--scale", options->how.scale,
                      "For trials: a part of the faces and cycles, above 0, at most 1 (default 1)");
  command->add_flag("--markdown", options->markdown, "Print the tables as Markdown");
  command->add_option("--file", options->file, "Write the figures to this file as JSON, too");
}

}  // namespace footwall::commands
