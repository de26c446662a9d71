#include "engine/extract/auto_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/extract/cost/model.h"
#include "engine/extract/cost/rates_file.h"
#include "engine/extract/exchange/exchange.h"
#include "engine/extract/machine_rates.h"

namespace footwall::extract {
namespace {

// Among equals the first is taken. One that is not built, or not known to the model, is left out.
constexpr std::array<std::string_view, 6> kExchanges{"reduce",  "push",    "minimum",
                                                     "block=2", "block=4", "bounding"};
constexpr std::string_view kAuto = "auto";
// What another choice must promise before the one that runs is given up.
constexpr double kBetter = 0.9;
// A gain that is lost in what the model does not know.
constexpr double kWorthIt = 0.98;
// A decision may cost this share of the time that it decides about, which is usually several extractions.
constexpr double kShare = 0.01;
constexpr double kExtractionsDecided = 4;
// So few faces are extracted in next to no time; to look at balancers for them takes longer.
constexpr std::size_t kFewFaces = 256;
constexpr double kMillion = 1e6;

struct Asked {
  bool exchange = false;
  bool balance = false;
};
Asked asked_for(const Options& options) {
  return {parse_choice(options.exchange).name == kAuto, parse_choice(options.balance).name == kAuto};
}

bool can_run(const Choice& exchange, bool needs_voxels) {
  const std::span<const ExchangeStrategy> rows = exchange_strategies();
  const auto row = std::find_if(rows.begin(), rows.end(),
                                [&](const ExchangeStrategy& each) { return each.name == exchange.name; });
  return row != rows.end() && row->run != nullptr && (row->moves_voxels || !needs_voxels);
}

std::vector<Choice> exchanges_for(const Options& options, bool needs_voxels) {
  std::vector<Choice> choices;
  if (!asked_for(options).exchange) {
    choices.push_back(parse_choice(options.exchange));
    return choices;
  }
  for (const std::string_view text : kExchanges) {
    const Choice choice = parse_choice(text);
    if (can_run(choice, needs_voxels)) choices.push_back(choice);
  }
  return choices;
}

// Balancers in the order of their promise. d in voxel^2 of area: 0, and a twentieth of the mean load, so that
// (section 6.4.1) it is set from the workload; tau: 1, 2, infinite.
std::vector<std::string> balancers_for(const Options& options, double mean_load) {
  if (!asked_for(options).balance) return {options.balance};
  constexpr double kThreshold = 0.05;
  constexpr double kVoxelsPerArea = 1.5;  // a face of random direction cuts so many voxels per voxel^2
  const auto d = static_cast<std::int64_t>(kThreshold * mean_load / kVoxelsPerArea);
  std::vector<std::string> all{"none",
                               "minimal",
                               "local=0",
                               "manhattan=0,1",
                               "manhattan=0,2",
                               "manhattan=0",
                               "global=0",
                               "local=" + std::to_string(d),
                               "global=" + std::to_string(d)};
  std::erase_if(all, [](const std::string& text) {
    const std::string name = parse_choice(text).name;
    const auto rows = balance_strategies();
    return std::none_of(rows.begin(), rows.end(),
                        [&](const BalanceStrategy& row) { return row.name == name && row.run != nullptr; });
  });
  return all;
}

std::int64_t picoseconds(double seconds) {
  constexpr double kPico = 1e12;
  constexpr double kMost = 1e15;  // a quarter of an hour
  return static_cast<std::int64_t>(std::clamp(seconds * kPico, 1.0, kMost));
}

// As evenly as no balancer can do it: what any of them could gain at most.
std::vector<RankAmounts> evened(std::vector<RankAmounts> ranks) {
  double faces = 0;
  double voxels = 0;
  for (const RankAmounts& rank : ranks) {
    faces += rank.faces;
    voxels += rank.voxels;
  }
  for (RankAmounts& rank : ranks) {
    rank.faces = faces / static_cast<double>(ranks.size());
    rank.voxels = voxels / static_cast<double>(ranks.size());
  }
  return ranks;
}

class Decision {
 public:
  Decision(const Situation& situation, const MachineRates& rates)
      : situation_(situation),
        rates_(rates),
        whole_(whole_face_computations(situation.options)),
        exchanges_(exchanges_for(situation.options, !whole_.empty())),
        voxels_(expected_voxels(situation.faces, situation.grid.dims())),
        sample_(situation.grid, situation.faces, asks_for(situation.options, "discontinuity") ? 1 : 0) {
    for (const std::int64_t voxels : voxels_) all_voxels_ += static_cast<double>(voxels);
    for (const Computation* each : whole_) whole_face_ += rates.whole_face_voxel(std::string(each->name));
    std::erase_if(exchanges_, [](const Choice& choice) { return !has_model(choice); });
    costs_.voxel = picoseconds(rates.voxelize + rates.gather + whole_face_);
    costs_.remote = picoseconds(2 * rates.pack + 4 * rates.byte);
    costs_.message = picoseconds(rates.alpha);
    costs_.horizon = static_cast<std::int64_t>(kExtractionsDecided);
  }

  bool possible() const { return !exchanges_.empty(); }

  Chosen run() {
    const auto ranks = static_cast<double>(situation_.grid.ranks());
    const std::vector<std::string> balancers = balancers_for(situation_.options, all_voxels_ / ranks);
    const bool keeps = situation_.incumbent != nullptr && is_candidate(*situation_.incumbent, balancers);
    look(balancers.front());
    if (keeps && situation_.incumbent->balance != balancers.front()) look(situation_.incumbent->balance);
    // Is there something that a balancer could gain, and is there time to look for it?
    const double look_seconds =
        rates_.balance * static_cast<double>(situation_.faces.size()) * std::max(1.0, ranks / rates_.cores);
    double budget =
        situation_.faces.size() < kFewFaces ? 0 : kShare * kExtractionsDecided * best().seconds.total;
    for (const std::string& balancer : balancers) {
      if (std::find(looked_.begin(), looked_.end(), balancer) != looked_.end()) continue;
      if (budget < look_seconds || bound_ + look_seconds > kWorthIt * best().seconds.total) break;
      budget -= look_seconds;
      look(balancer);
    }
    return chosen(keeps);
  }

 private:
  struct Candidate {
    std::string exchange, balance;
    Seconds seconds;
  };

  bool is_candidate(const Chosen& chosen, const std::vector<std::string>& balancers) const {
    return std::find(balancers.begin(), balancers.end(), chosen.balance) != balancers.end() &&
           std::any_of(exchanges_.begin(), exchanges_.end(),
                       [&](const Choice& choice) { return choice.text() == chosen.exchange; });
  }

  // What every exchange would take with this balancer.
  void look(const std::string& balancer) {
    looked_.push_back(balancer);
    const Choice choice = parse_choice(balancer);
    const std::vector<int> responsible =
        balance_strategy(choice.name)
            .run({situation_.grid, situation_.faces, choice, {}, voxels_, nullptr, costs_});
    const std::vector<RankAmounts> ranks = sample_.amounts(responsible, voxels_);
    // Every rank deals out all faces.
    const auto all = static_cast<double>(ranks.size());
    const double balance = choice.name == "none" ? 0
                                                 : rates_.balance * static_cast<double>(voxels_.size()) *
                                                       std::max(1.0, all / rates_.cores);
    const bool first = looked_.size() == 1;
    const std::vector<RankAmounts> even = first ? evened(ranks) : std::vector<RankAmounts>{};
    for (const Choice& exchange : exchanges_) {
      Candidate candidate{exchange.text(), balancer, predict(exchange, workload(ranks), rates_)};
      candidate.seconds.balance = balance;
      candidate.seconds.total += balance;
      candidates_.push_back(candidate);
      if (first) {
        const double least = predict(exchange, workload(even), rates_).total;
        bound_ = candidates_.size() == 1 ? least : std::min(bound_, least);
      }
    }
  }

  Workload workload(std::span<const RankAmounts> ranks) const {
    return {ranks, situation_.options.threads, asks_for(situation_.options, "discontinuity"), whole_face_,
            situation_.cached};
  }

  const Candidate& best() const {
    return *std::min_element(
        candidates_.begin(), candidates_.end(),
        [](const Candidate& a, const Candidate& b) { return a.seconds.total < b.seconds.total; });
  }
  const Candidate* other_than(const Candidate& taken) const {
    const Candidate* second = nullptr;
    for (const Candidate& each : candidates_) {
      if (&each == &taken) continue;
      if (second == nullptr || each.seconds.total < second->seconds.total) second = &each;
    }
    return second;
  }

  Chosen chosen(bool keeps) const {
    const Candidate* taken = &best();
    bool kept = false;
    for (const Candidate& each : candidates_) {
      const bool incumbent = keeps && each.exchange == situation_.incumbent->exchange &&
                             each.balance == situation_.incumbent->balance;
      if (!incumbent || taken->seconds.total <= kBetter * each.seconds.total) continue;
      taken = &each;
      kept = true;
    }
    constexpr double kMilli = 1e3;
    Chosen chosen{taken->exchange, taken->balance, {},
                  taken->seconds,  costs_,         static_cast<int>(looked_.size())};
    chosen.reason = fmt::format(
        "{} with {}{}: {:.3g} ms predicted for {} faces of {:.3g} million voxels on {} ranks of {} threads "
        "and {} cores",
        taken->exchange, taken->balance, kept ? ", as before" : "", kMilli * taken->seconds.total,
        situation_.faces.size(), all_voxels_ / kMillion, situation_.grid.ranks(), situation_.options.threads,
        rates_.cores);
    if (const Candidate* other = other_than(*taken)) {
      if (taken->seconds.total > 0) chosen.margin = other->seconds.total / taken->seconds.total;
      chosen.reason += fmt::format("; {} with {} {:.3g} ms", other->exchange, other->balance,
                                   kMilli * other->seconds.total);
    }
    return chosen;
  }

  const Situation& situation_;
  const MachineRates& rates_;
  std::vector<const Computation*> whole_;
  std::vector<Choice> exchanges_;
  std::vector<std::int64_t> voxels_;
  FaceSample sample_;
  BalanceCosts costs_;
  double all_voxels_ = 0;
  double whole_face_ = 0;
  std::vector<std::string> looked_;
  std::vector<Candidate> candidates_;
  double bound_ = 0;  // what no balancer can do better
};

// Where the model is not asked: the first that can run, and no balancer.
Chosen without_model(const Options& options, std::string reason) {
  const Asked asked = asked_for(options);
  Chosen chosen{options.exchange, options.balance, std::move(reason), {}, {}, 0};
  if (asked.exchange)
    chosen.exchange = exchanges_for(options, !whole_face_computations(options).empty()).at(0).text();
  if (asked.balance) chosen.balance = "none";
  return chosen;
}

}  // namespace

bool asks_for_choice(const Options& options) {
  const Asked asked = asked_for(options);
  return asked.exchange || asked.balance;
}

Chosen choose(const Situation& situation, const MachineRates& rates) {
  if (!asks_for_choice(situation.options)) return without_model(situation.options, "");
  if (situation.grid.ranks() == 1) return without_model(situation.options, "one rank: nothing has to move");
  if (situation.faces.empty()) return without_model(situation.options, "there are no faces");
  Decision decision(situation, rates);
  if (!decision.possible())
    return without_model(situation.options, "the cost model does not know this exchange");
  return decision.run();
}

std::string outcome_in_words(const Report& report) {
  constexpr double kMilli = 1e3;
  const auto phase = [](const char* name, double real, double predicted) {
    return fmt::format("{} {:.3g} ({:.3g})", name, kMilli * real, kMilli * predicted);
  };
  const Seconds& real = report.seconds;
  const Seconds& predicted = report.predicted;
  return fmt::format("{} with {}, ms (predicted): {}, {}, {}, {}", report.exchange, report.balance,
                     phase("balance", real.balance, predicted.balance),
                     phase("voxelize", real.voxelize, predicted.voxelize),
                     phase("exchange", real.exchange, predicted.exchange),
                     phase("compute", real.compute, predicted.compute));
}

void AutoChoice::prepare(const comm::Communicator& world, const Options& options) {
  if (rates_ || world.size() == 1 || !asks_for_choice(options)) return;
  rates_ = machine_rates(world, rates_folder());
}

Chosen AutoChoice::decide(const comm::RankGrid& grid, std::span<const Face> faces, const Options& options) {
  if (!asks_for_choice(options)) return choose({grid, faces, options}, {});
  // A glance at some faces tells whether the situation is the old one.
  constexpr std::size_t kGlance = 128;
  const std::size_t glanced = std::min(kGlance, faces.size());
  std::vector<Face> some;
  for (std::size_t n = 0; n < glanced; ++n) some.push_back(faces[n * faces.size() / glanced]);
  double voxels = 0;
  for (const std::int64_t each : expected_voxels(some, grid.dims())) voxels += static_cast<double>(each);
  if (glanced > 0) voxels *= static_cast<double>(faces.size()) / static_cast<double>(glanced);

  const auto count = static_cast<double>(faces.size());
  if (holds(options, count, voxels)) return last_->chosen;
  remote_voxels_ = static_cast<double>(grid.dims()[0]) * static_cast<double>(grid.dims()[1]) *
                   static_cast<double>(grid.dims()[2]) * (grid.ranks() - 1);
  const bool comparable = last_ && last_->options == options;
  const Situation situation{grid, faces, options, cached_, comparable ? &last_->chosen : nullptr};
  const Chosen chosen = choose(situation, rates_.value_or(MachineRates{}));
  // A few faces between two full extractions are no reason to forget what those found.
  if (!last_ || faces.size() >= kFewFaces || last_->faces < kFewFaces) {
    constexpr int kPatience = 2;
    constexpr int kMostPatience = 1 << 20;
    const bool same =
        comparable && last_->chosen.exchange == chosen.exchange && last_->chosen.balance == chosen.balance;
    const bool in_vain = same && last_->wrong >= last_->patience;
    const int patience = in_vain ? std::min(kMostPatience, 2 * last_->patience) : kPatience;
    last_ = Memory{options, count, voxels, cached_, chosen, 0, patience};
  }
  Chosen fresh = chosen;
  fresh.is_new = true;
  return fresh;
}

bool AutoChoice::holds(const Options& options, double faces, double voxels) const {
  constexpr double kChange = 1.1;
  constexpr double kMostChange = 1.5;
  constexpr double kCachedChange = 0.2;
  if (!last_ || last_->options != options || last_->wrong >= last_->patience) return false;
  const double change = std::clamp(last_->chosen.margin, kChange, kMostChange);
  const auto near = [&](double now, double then) { return now * change >= then && now <= change * then; };
  return near(faces, last_->faces) && near(voxels, last_->voxels) &&
         (change == kMostChange || std::abs(cached_ - last_->cached) <= kCachedChange);
}

void AutoChoice::learn(const Report& report) {
  if (remote_voxels_ > 0)
    cached_ = std::clamp(static_cast<double>(report.cache_voxels) / remote_voxels_, 0.0, 1.0);
  if (!last_ || last_->chosen.predicted.total <= 0 ||
      parse_choice(report.exchange).name != parse_choice(last_->chosen.exchange).name)
    return;
  constexpr double kWrong = 0.2;
  constexpr double kTooShort = 1e-3;  // s: noise
  const Seconds& real = report.seconds;
  const double took = real.balance + real.voxelize + real.exchange + real.compute;
  const double expected = last_->chosen.predicted.total;
  if (took < kTooShort || std::abs(took / expected - 1) <= kWrong) {
    last_->wrong = 0;
    return;
  }
  if (++last_->wrong == last_->patience) correct(last_->chosen.predicted, real);
}

void AutoChoice::correct(const Seconds& predicted, const Seconds& real) {
  if (!rates_) return;
  constexpr double kMost = 2;  // at a time: one measurement may be far off by chance
  const auto factor = [kMost](double took, double expected) {
    return expected > 0 ? std::clamp(took / expected, 1 / kMost, kMost) : 1;
  };
  const double computing = factor(real.voxelize + real.compute, predicted.voxelize + predicted.compute);
  const double moving = factor(real.exchange, predicted.exchange);
  for (double MachineRates::*rate : {&MachineRates::voxelize, &MachineRates::gather, &MachineRates::fold,
                                     &MachineRates::fold_discontinuity, &MachineRates::face})
    (*rates_).*rate *= computing;
  for (MachineRates::WholeFace& each : rates_->whole_face) each.voxel *= computing;
  for (double MachineRates::*rate :
       {&MachineRates::alpha, &MachineRates::overhead, &MachineRates::byte, &MachineRates::pack})
    (*rates_).*rate *= moving;
}

}  // namespace footwall::extract
