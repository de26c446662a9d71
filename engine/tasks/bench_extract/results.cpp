#include "engine/tasks/bench_extract/results.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/extract/choice.h"
#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

using Json = nlohmann::json;

template <typename T>
void add_new(const T& value, std::vector<T>& list) {
  if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
}

std::vector<double> sorted(const std::vector<BenchRun>& runs, double BenchRun::*of) {
  require(!runs.empty(), "a cell with runs");
  std::vector<double> values(runs.size());
  std::transform(runs.begin(), runs.end(), values.begin(), [of](const BenchRun& run) { return run.*of; });
  std::sort(values.begin(), values.end());
  return values;
}

double median_of(const std::vector<double>& sorted_values) {
  const std::size_t middle = sorted_values.size() / 2;
  return sorted_values.size() % 2 == 1 ? sorted_values[middle]
                                       : (sorted_values[middle - 1] + sorted_values[middle]) / 2;
}

}  // namespace

std::string name_of(const StrategyPair& pair) {
  return pair.exchange + ", " + pair.balance;
}

bool is_of_seed(const StrategyPair& pair) {
  const extract::Choice exchange = extract::parse_choice(pair.exchange);
  const extract::Choice balance = extract::parse_choice(pair.balance);
  const auto one_of = [](const std::string& name, std::initializer_list<const char*> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  return one_of(exchange.name, {"minimum", "block", "bounding"}) &&
         one_of(balance.name, {"none", "global", "local", "manhattan"}) &&
         std::find(balance.parameters.begin(), balance.parameters.end(), "cache") == balance.parameters.end();
}

BenchRun run_from(const std::string& result_json) {
  try {
    const Json json = Json::parse(result_json);
    const Json& seconds = json.at("seconds");
    BenchRun run;
    json.at("slowest_rank").get_to(run.slowest_rank);
    json.at("quickest_rank").get_to(run.quickest_rank);
    seconds.at("apply").get_to(run.apply);
    seconds.at("balance").get_to(run.balance);
    seconds.at("voxelize").get_to(run.voxelize);
    seconds.at("exchange").get_to(run.exchange);
    seconds.at("compute").get_to(run.compute);
    seconds.at("wait").get_to(run.wait);
    json.at("bytes_sent").get_to(run.bytes);
    json.at("messages").get_to(run.messages);
    json.at("most_bytes_sent").get_to(run.most_bytes);
    json.at("most_messages").get_to(run.most_messages);
    json.at("cache_hits").get_to(run.cache_hits);
    json.at("load_deviation").get_to(run.load_deviation);
    json.at("load_max_over_mean").get_to(run.load_max_over_mean);
    json.at("checksum").get_to(run.checksum);
    return run;
  } catch (const Json::exception& error) {
    throw Error(ErrorCode::kEngine,
                std::string("the engine's answer to a workload cannot be read: ") + error.what(),
                "footwall and footwall-engine must be of the same version");
  }
}

double BenchCell::median(double BenchRun::*of) const {
  return median_of(sorted(runs, of));
}
double BenchCell::median_apart(double BenchRun::*of) const {
  return median_of(sorted(apart.empty() ? runs : apart, of));
}
double BenchCell::least(double BenchRun::*of) const {
  return sorted(runs, of).front();
}
double BenchCell::most(double BenchRun::*of) const {
  return sorted(runs, of).back();
}

const BenchCell* BenchResult::find(int benchmark, int ranks, const StrategyPair& pair) const {
  const auto found = std::find_if(cells.begin(), cells.end(), [&](const BenchCell& cell) {
    return cell.benchmark == benchmark && cell.ranks == ranks && cell.pair == pair;
  });
  return found == cells.end() ? nullptr : &*found;
}

const BenchCell* BenchResult::serial(int benchmark) const {
  const BenchCell* best = nullptr;
  for (const BenchCell& cell : cells) {
    if (cell.benchmark != benchmark || cell.ranks != 1) continue;
    if (best == nullptr || cell.median(&BenchRun::slowest_rank) < best->median(&BenchRun::slowest_rank))
      best = &cell;
  }
  return best;
}

const extract::MachineRates* BenchResult::rates_of(int ranks) const {
  const auto found = std::find_if(rates.begin(), rates.end(),
                                  [&](const extract::MachineRates& each) { return each.ranks == ranks; });
  return found == rates.end() ? nullptr : &*found;
}

std::vector<int> BenchResult::benchmarks() const {
  std::vector<int> list;
  for (const BenchCell& cell : cells) add_new(cell.benchmark, list);
  return list;
}
std::vector<int> BenchResult::ranks() const {
  std::vector<int> list;
  for (const BenchCell& cell : cells) add_new(cell.ranks, list);
  std::sort(list.begin(), list.end());
  return list;
}
std::vector<StrategyPair> BenchResult::pairs() const {
  std::vector<StrategyPair> list;
  for (const BenchCell& cell : cells) add_new(cell.pair, list);
  return list;
}

}  // namespace footwall::tasks
