// Who is responsible for which face. A strategy is one file in this folder and one row in strategies.cpp.
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "engine/comm/rank_grid.h"
#include "engine/extract/face.h"

namespace footwall::extract {

// The responsible rank of every face. No communication: every rank computes the same. run is null for a
// strategy that is known by name but not built.
struct BalanceStrategy {
  std::string_view name;
  std::string_view help;
  std::vector<int> (*run)(const comm::RankGrid& grid, std::span<const Face> faces);
};
std::span<const BalanceStrategy> balance_strategies();
// The one of a name of balance_rows() that is built.
const BalanceStrategy& balance_strategy(std::string_view name);

}  // namespace footwall::extract
