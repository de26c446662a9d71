// `auto`: which exchange and which balancer an extraction runs, by the cost model and this machine's rates.
// Based on: seed 004, section 6.4.1, whose nine characteristics are named where they are used; differs in
// that a candidate is only looked at while it may gain more than the look costs (as dynamic balancers do
// with their profit rule).
#pragma once
#include <optional>
#include <span>
#include <string>

#include "engine/comm/communicator.h"
#include "engine/comm/rank_grid.h"
#include "engine/extract/balance/balance.h"
#include "engine/extract/cost/rates.h"
#include "engine/extract/extract.h"

namespace footwall::extract {

// Whether the options leave anything to choose.
bool asks_for_choice(const Options& options);

// What was chosen, as options write it ("block=2", "manhattan=0,2").
struct Chosen {
  std::string exchange;
  std::string balance;
  std::string reason;       // in words, for the report and the log; empty where nothing was left to choose
  Seconds predicted;        // zeros where the model was not asked
  BalanceCosts costs = {};  // what the balancer is to weigh with
  int looked_at = 0;        // balancers that were run to see what they do
  bool is_new = false;      // not what is remembered from an extraction before
  double margin = 1;        // what the next best was predicted to take, over this
};

// What decides, known alike on every rank.
struct Situation {
  const comm::RankGrid& grid;   // (1) data set size, (8) number of nodes
  std::span<const Face> faces;  // (2) polygon size, (3) number; (4) meshes do not matter beyond their faces
  const Options& options;       // (7) which computation, and threads
  double cached = 0;            // share of remote voxels at hand: what (5) cycles and (6) moves come to
  // The choice of the extraction before, which another must beat by a tenth; null for the first.
  const Chosen* incumbent = nullptr;
};

// The choice for one situation, from nothing but its arguments: every rank that has the same makes the same.
// (9) machine and interconnect: rates. Throws kUsage as validate() does.
Chosen choose(const Situation& situation, const MachineRates& rates);

// "push with minimal took 12.1 ms (12.9 predicted): voxelize 3 (3.1), ..."
std::string outcome_in_words(const Report& report);

// What is remembered from one extraction of a survey to the next.
class AutoChoice {
 public:
  // Reads or measures the rates, the first time that something has to be chosen among several ranks: then
  // collective, else without communication.
  void prepare(const comm::Communicator& world, const Options& options);

  // What to run for `options`. Where nothing says "auto" that is what they say. Else it is chosen anew only
  // where the situation has changed: other options, a tenth more or fewer faces or voxels, remote voxels
  // that were kept meanwhile, or predictions that were wrong by more than a fifth twice in a row. The farther
  // off the next best was, up to half as much again, the more may change; and each time that the choice stays
  // the same, twice as many wrong predictions are put up with. Not collective, alike on every rank; after
  // prepare(). Throws kUsage, std::bad_alloc.
  Chosen decide(const comm::RankGrid& grid, std::span<const Face> faces, const Options& options);

  // What became of it: corrects the rates where they were wrong. `report` is alike on every rank, as far as
  // it is looked at.
  void learn(const Report& report);
  // The remote voxels that were kept are gone.
  void forget_cached() { cached_ = 0; }

 private:
  struct Memory {
    Options options;
    double faces = 0;
    double voxels = 0;
    double cached = 0;
    Chosen chosen;
    int wrong = 0;  // predictions in a row that were
    int patience;   // with them
  };
  bool holds(const Options& options, double faces, double voxels) const;
  void correct(const Seconds& predicted, const Seconds& real);

  std::optional<MachineRates> rates_;
  std::optional<Memory> last_;
  double cached_ = 0;
  double remote_voxels_ = 0;  // that all ranks together could keep
};

}  // namespace footwall::extract
