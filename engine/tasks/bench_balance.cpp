#include "engine/tasks/bench_balance.h"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "engine/extract/balance/balance.h"
#include "engine/extract/balance/local.h"
#include "engine/extract/balance/start.h"
#include "engine/extract/registry.h"
#include "engine/extract/replay/replay.h"
#include "engine/verify/balance_by_pseudocode.h"
#include "storage/base/error.h"
#include "storage/base/text.h"

namespace footwall::tasks {
namespace {

using extract::Choice;
using extract::Face;

constexpr int kMostChecked = 16;  // ranks for which the slow pseudocode runs
constexpr int kMostRanks = 65536;

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

bool is_running(const Choice& choice) {
  return choice.name == "local" && choice.parameters.size() == 2 && choice.parameters[1] == "running";
}

void check(const BenchBalanceOptions& options) {
  for (const int ranks : options.ranks) {
    if (ranks < 1 || ranks > kMostRanks)
      throw Error(ErrorCode::kUsage, fmt::format("{} ranks cannot be replayed", ranks),
                  fmt::format("give 1 to {}", kMostRanks));
  }
  for (const auto& [a, b] : options.pillars) {
    if (a < 1 || b < 1 || a > 1024 || b > 1024)
      throw Error(ErrorCode::kUsage, fmt::format("{}x{} pillars are none", a, b), "give 1 to 1024 each way");
  }
  for (const double delta : options.deltas) {
    if (!(delta >= 0 && delta <= 1e6))
      throw Error(ErrorCode::kUsage, fmt::format("{} is no threshold", delta), "give a number from 0 on");
  }
  for (const std::string& text : options.strategies) {
    const Choice choice = extract::parse_choice(text);
    if (is_running(choice)) continue;
    extract::find_row(extract::balance_rows(), "balance", text);
    extract::balance_strategy(choice.name).check(choice);
  }
}

// Those of seed 004; all others are replayed once, as they are.
bool takes_threshold(std::string_view name) {
  return name == "global" || name == "local" || name == "manhattan";
}

// The strategies of one grid, in the order in which they are printed.
std::vector<std::string> strategies_of(const BenchBalanceOptions& options, const comm::RankGrid& grid,
                                       double mean_area, bool with_cache) {
  if (!options.strategies.empty()) return options.strategies;
  std::vector<int> taus = options.taus;
  if (taus.empty()) {
    taus.resize(static_cast<std::size_t>(std::max(0, grid.parts()[0] + grid.parts()[1] - 2)));
    std::iota(taus.begin(), taus.end(), 1);
  }
  std::vector<std::string> all;
  for (const extract::BalanceStrategy& row : extract::balance_strategies()) {
    if (row.name != "auto" && !takes_threshold(row.name)) all.emplace_back(row.name);
  }
  for (const double delta : options.deltas) {
    const std::string d = text::shortest(std::floor(delta * mean_area));
    all.push_back("global=" + d);
    all.push_back("local=" + d);
    all.push_back("local=" + d + ",running");
    if (with_cache) all.push_back("local=" + d + ",cache");
    all.push_back("manhattan=" + d);
    for (const int tau : taus) all.push_back(fmt::format("manhattan={},{}", d, tau));
  }
  return all;
}

// Seed 004, table F.4: benchmark 2, 2 to 256 CPUs.
std::optional<double> published(const Choice& choice, int ranks) {
  static const std::map<std::string, std::array<double, 8>> kTable{
      {"none", {4035741, 2795743, 1409932, 764145, 440201, 255620, 134062, 70636}},
      {"global=0", {59952, 54850, 138740, 121864, 81925, 53437, 28854, 15577}},
      {"local=0", {3221577, 2259919, 1062365, 520218, 264423, 136158, 68542, 34525}},
      {"manhattan=0", {59952, 54951, 161597, 139445, 90575, 58135, 31003, 16763}},
      {"manhattan=0,2", {59952, 54951, 549288, 536090, 383139, 245467, 129715, 68884}}};
  const std::string text =
      choice.parameters.empty() && choice.name != "none" ? choice.name + "=0" : choice.text();
  const auto row = kTable.find(text);
  if (row == kTable.end()) return std::nullopt;
  for (std::size_t n = 0; n < row->second.size(); ++n) {
    if (ranks == 2 << n) return row->second[n];
  }
  return std::nullopt;
}

bool is_benchmark_2(const Extractions& extractions) {
  const auto near = [](double value, double wanted) { return std::abs(value - wanted) <= 0.1 * wanted; };
  return extractions.dims == survey::Index{200, 200, 100} &&
         near(static_cast<double>(extractions.faces.back().size()), 10000);
}

void demand(bool right, const std::string& strategy, const char* what) {
  if (!right)
    throw Error(ErrorCode::kInternal, fmt::format("balance '{}': {}", strategy, what),
                "please report this with the faces");
}

void check_sums(const std::string& strategy, const extract::Amounts& amounts, const extract::Pieces& pieces,
                std::span<const Face> faces) {
  const auto sum = [](const std::vector<std::int64_t>& list) {
    return std::accumulate(list.begin(), list.end(), std::int64_t{0});
  };
  const std::int64_t voxels = sum(pieces.voxels);
  demand(sum(amounts.area) == sum(extract::fixed_areas(faces)), strategy, "areas that do not add up");
  demand(sum(amounts.voxels) == voxels && sum(amounts.owned) == voxels, strategy,
         "voxels that do not add up");
  std::int64_t remote = 0;
  for (const extract::Pair& pair : amounts.pairs) remote += pair.voxels;
  demand(remote == amounts.remote && remote <= voxels, strategy, "remote voxels that do not add up");
}

// Whether the decision was compared with the pseudocode, which must then agree.
bool check_pseudocode(const extract::BalanceInput& input, const std::vector<int>& ranks,
                      const Choice& choice) {
  const bool cached = choice.parameters.size() > 1 && choice.parameters[1] == "cache";
  if (input.grid.ranks() > kMostChecked || cached) return false;
  const extract::Start start = extract::start_of(input);
  verify::BalanceCase given;
  given.ranks = input.grid.ranks();
  given.threshold = start.threshold;
  std::vector<int> got;
  for (const std::uint32_t n : start.by_id) {
    given.areas.push_back(start.areas[n]);
    given.start.push_back(start.responsible[n]);
    got.push_back(ranks[n]);
  }
  std::vector<int> wanted;
  if (choice.name == "none") {
    wanted = given.start;
  } else if (choice.name == "global") {
    wanted = verify::global_by_pseudocode(given);
  } else if (choice.name == "manhattan") {
    const auto tau = choice.whole(1, "distance of ranks", -1, -1, kMostRanks);
    wanted = verify::manhattan_by_pseudocode(given, static_cast<int>(tau),
                                             [&](int a, int b) { return input.grid.distance(a, b); });
  } else if (choice.name == "local") {
    const auto meets = [&](int rank, std::size_t place) {
      const survey::Box box = extract::voxel_box(input.faces[start.by_id[place]]);
      const std::vector<survey::Box> boxes = input.grid.boxes(rank);
      return std::any_of(boxes.begin(), boxes.end(),
                         [&](const survey::Box& own) { return !survey::intersection(own, box).empty(); });
    };
    wanted = verify::local_by_pseudocode(given, meets, is_running(choice));
  } else {
    return false;
  }
  demand(got == wanted, choice.text(), "not what the pseudocode gives");
  return true;
}

// One grid, all of its strategies, over the EXTRACT-ALLs.
class GridBench {
 public:
  GridBench(const Extractions& extractions, const comm::RankGrid& grid, const BenchBalanceOptions& options,
            BenchBalanceResult& result)
      : extractions_(extractions),
        grid_(grid),
        exchange_(extract::parse_choice(options.exchange)),
        result_(result) {
    for (const std::string& text :
         strategies_of(options, grid, result.mean_area, extractions.faces.size() > 1)) {
      BalanceRow row;
      row.ranks = grid.ranks();
      row.pillars = grid.pillars();
      row.strategy = text;
      row.area_max_over_mean = row.voxels_max_over_mean = 0;
      if (is_benchmark_2(extractions) && grid.pillars() == std::array{1, 1})
        row.published = published(extract::parse_choice(text), grid.ranks());
      rows_.push_back(row);
      caches_.emplace_back(grid);
    }
  }

  void run(const JobContext& job) {
    for (const std::vector<Face>& faces : extractions_.faces) {
      const extract::Pieces pieces = extract::pieces_of(grid_, faces, job);
      for (std::size_t n = 0; n < rows_.size(); ++n) one(faces, pieces, rows_[n], caches_[n], job);
    }
    result_.rows.insert(result_.rows.end(), rows_.begin(), rows_.end());
  }

 private:
  void one(const std::vector<Face>& faces, const extract::Pieces& pieces, BalanceRow& row,
           extract::CacheDirectory& cache, const JobContext& job) {
    job.check();
    const Choice choice = extract::parse_choice(row.strategy);
    const extract::BalanceInput input{grid_, faces, choice, {}, {}, &cache, {}};
    const double start = processor_seconds();
    const std::vector<int> ranks = is_running(choice)
                                       ? extract::balance_local(input, extract::LocalMean::kRunning)
                                       : extract::balance_strategy(choice.name).run(input);
    const double decided = processor_seconds() - start;
    demand(ranks.size() == faces.size(), row.strategy, "not one rank for every face");
    const extract::Amounts amounts = extract::amounts_of(grid_, faces, pieces, ranks);
    check_sums(row.strategy, amounts, pieces, faces);
    result_.checked += check_pseudocode(input, ranks, choice) ? 1 : 0;
    cache.add(faces, ranks);
    const extract::Sent sent = extract::sent_by(grid_, faces, pieces, ranks, exchange_, 0, job);
    const extract::Predicted predicted = extract::predict(amounts, sent);
    const std::vector<int> centroid = extract::starting_ranks(input);
    std::int64_t moved = 0;
    for (std::size_t n = 0; n < ranks.size(); ++n) moved += ranks[n] != centroid[n] ? 1 : 0;
    const double share = 1 / static_cast<double>(extractions_.faces.size());
    row.deviation += share * amounts.area_deviation;
    row.area_max_over_mean += share * amounts.area_max_over_mean;
    row.voxels_max_over_mean += share * amounts.voxels_max_over_mean;
    row.remote_voxels += share * static_cast<double>(amounts.remote);
    row.sent_bytes += share * static_cast<double>(sent.bytes);
    row.moved_faces += share * static_cast<double>(moved);
    row.compute_seconds += share * predicted.compute;
    row.exchange_seconds += share * predicted.exchange;
    row.decision_seconds += share * decided;
    if (result_.rows.empty() && &row == &rows_.front())
      result_.mean_voxels += share * static_cast<double>(std::accumulate(
                                         pieces.voxels.begin(), pieces.voxels.end(), std::int64_t{0}));
  }

  const Extractions& extractions_;
  const comm::RankGrid& grid_;
  Choice exchange_;
  BenchBalanceResult& result_;
  std::vector<BalanceRow> rows_;
  std::vector<extract::CacheDirectory> caches_;
};

}  // namespace

BenchBalanceResult bench_balance(const Extractions& extractions, const BenchBalanceOptions& options,
                                 const JobContext& job) {
  check(options);
  require(!extractions.faces.empty(), "at least one EXTRACT-ALL");
  BenchBalanceResult result;
  result.dims = extractions.dims;
  result.extractions = static_cast<std::int64_t>(extractions.faces.size());
  result.faces = static_cast<std::int64_t>(extractions.faces.back().size());
  double area = 0;
  double faces = 0;
  for (const std::vector<Face>& each : extractions.faces) {
    for (const extract::FixedArea part : extract::fixed_areas(each)) area += extract::voxel2(part);
    faces += static_cast<double>(each.size());
  }
  if (faces > 0) result.mean_area = area / faces;
  const auto grids = static_cast<double>(options.ranks.size() * options.pillars.size());
  double done = 0;
  for (const int ranks : options.ranks) {
    for (const std::array<int, 2>& pillars : options.pillars) {
      job.report(done++ / grids, "replay",
                 fmt::format("{} ranks, {}x{} pillars", ranks, pillars[0], pillars[1]));
      const comm::RankGrid grid(extractions.dims, ranks, pillars);
      GridBench(extractions, grid, options, result).run(job);
    }
  }
  job.report(1, "done");
  return result;
}

}  // namespace footwall::tasks
