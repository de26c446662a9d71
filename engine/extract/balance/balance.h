// Who is responsible for which face. A strategy is one file in this folder and one row in strategies.cpp.
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "engine/comm/rank_grid.h"
#include "engine/extract/choice.h"
#include "engine/extract/face.h"

namespace footwall::extract {

// What is known alike on every rank.
struct BalanceInput {
  const comm::RankGrid& grid;
  std::span<const Face> faces;
  const Choice& choice;  // the strategy with its parameters
  // The rank that was responsible for each face in the last extraction, -1 for a face that is new or has
  // changed; empty for a full extraction, which starts from the centroid ranks.
  std::span<const int> previous;
};

// The responsible rank of every face. No communication: every rank computes the same. run and check are null
// for a strategy that is known by name but not built.
struct BalanceStrategy {
  std::string_view name;
  std::string_view help;
  std::vector<int> (*run)(const BalanceInput& input);
  void (*check)(const Choice& choice);  // throws kUsage for parameters that it does not take
};
std::span<const BalanceStrategy> balance_strategies();
// The one of a name of balance_rows() that is built.
const BalanceStrategy& balance_strategy(std::string_view name);

}  // namespace footwall::extract
