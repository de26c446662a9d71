#include <algorithm>
#include <array>

#include "engine/extract/balance/balance.h"
#include "engine/extract/balance/global.h"
#include "engine/extract/balance/local.h"
#include "engine/extract/balance/manhattan.h"
#include "engine/extract/balance/minimal.h"
#include "engine/extract/balance/none.h"
#include "storage/base/error.h"

namespace footwall::extract {
namespace {

constexpr std::array kStrategies{
    // Run by itself, where nothing is known of the machine, it leaves the faces where they are; an extraction
    // asks auto_choice.h first and never runs it.
    BalanceStrategy{"auto", "by the cost model and what this machine was measured to do", &balance_none,
                    &check_none},
    BalanceStrategy{"none", "the rank of a face's centroid is responsible for it", &balance_none,
                    &check_none},
    BalanceStrategy{"minimal", "moves as few voxels as an even load needs, where that pays", &balance_minimal,
                    &check_minimal},
    BalanceStrategy{"global", "=D: faces of ranks loaded above the mean + D voxel^2 go to the emptiest ranks",
                    &balance_global, &check_global},
    BalanceStrategy{"local",
                    "=D[,cache]: such faces go to ranks that own (or have received) voxels near them",
                    &balance_local, &check_local},
    BalanceStrategy{"manhattan", "=D[,TAU]: such faces go to the nearest ranks with room, at most TAU away",
                    &balance_manhattan, &check_manhattan}};

}  // namespace

std::span<const BalanceStrategy> balance_strategies() {
  return kStrategies;
}

const BalanceStrategy& balance_strategy(std::string_view name) {
  const auto* row = std::find_if(kStrategies.begin(), kStrategies.end(),
                                 [&](const BalanceStrategy& s) { return s.name == name; });
  require(row != kStrategies.end() && row->run != nullptr, "a balancing strategy that was validated");
  return *row;
}

}  // namespace footwall::extract
