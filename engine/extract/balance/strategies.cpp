#include <algorithm>
#include <array>

#include "engine/extract/balance/balance.h"
#include "engine/extract/balance/none.h"
#include "storage/base/error.h"

namespace footwall::extract {
namespace {

constexpr std::array kStrategies{
    BalanceStrategy{"none", "the rank of a face's centroid is responsible for it", &balance_none,
                    &check_none},
    BalanceStrategy{"minimal", "moves as few voxels as an even load needs", nullptr, nullptr},
    BalanceStrategy{"global", "faces of overloaded ranks go to any other", nullptr, nullptr},
    BalanceStrategy{"local", "faces of overloaded ranks go to neighbours", nullptr, nullptr},
    BalanceStrategy{"manhattan", "faces go to the nearest rank with room", nullptr, nullptr}};

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
