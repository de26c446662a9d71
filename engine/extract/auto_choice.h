// `auto`: which exchange and which balancer an extraction runs, by the cost model and this machine's rates.
// Based on: seed 004, section 6.4.1, whose nine characteristics stand at the places where they are used; and
// the profit rule of dynamic balancing: a candidate is only looked at while it may gain more than the look
// costs.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/comm/rank_grid.h"
#include "engine/extract/cost/rates.h"
#include "engine/extract/extract.h"

namespace footwall::extract {

// What was chosen, as options write it ("block=2", "manhattan=0,2").
struct Chosen {
  std::string exchange;
  std::string balance;
  std::string reason;  // in words, for the report and the log; empty where nothing was left to choose
  Seconds predicted;   // zeros where the model was not asked
};

// What decides, known alike on every rank.
struct Situation {
  const comm::RankGrid& grid;  // (1) data set size, (8) number of nodes
  std::span<const Face> faces;  // (2) polygon size, (3) polygons; (4) meshes do not matter beyond them
  const Options& options;       // (7) computation, threads
  double cached = 0;  // share of remote voxels at hand: what (5) cycles and (6) distance of moves come to
};

// The choice for one situation, from nothing but its arguments: the same on every rank that has the same.
// (9) the machine: rates. Throws kUsage as validate().
Chosen choose(const Situation& situation, const MachineRates& rates);

// What is remembered from one extraction of a survey to the next.
class AutoChoice {
 public:
  // The names to run for `options`. Where nothing says "auto" they are the options' own, and nothing is
  // computed. Else decides anew only where the situation has changed: other options, a tenth more or fewer
  // faces or voxels, or a prediction that was wrong by more than a fifth twice; another choice must promise
  // to be a tenth faster to be taken. Rates are read or measured at the first decision with more than one
  // rank. Collective; all ranks get the same.
  Chosen decide(const comm::Communicator& world, const comm::RankGrid& grid, std::span<const Face> faces,
                const Options& options);
  // What became of it. The report is the same on every rank, but for walked_here.
  void learn(const Report& report);

 private:
  struct Memory {
    Options options;
    std::size_t faces = 0;
    double voxels = 0;
    Chosen chosen;
    int wrong = 0;  // predictions in a row that were
  };
  bool still_holds(const Options& options, std::size_t faces, double voxels) const;

  std::optional<MachineRates> rates_;
  std::optional<Memory> last_;
  double cached_ = 0;
};

}  // namespace footwall::extract
