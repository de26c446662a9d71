#include <algorithm>
#include <array>

#include "engine/extract/exchange/exchange.h"
#include "storage/base/error.h"

namespace footwall::extract {
namespace {

// What runs where nothing is known of the machine; an extraction asks auto_choice.h first.
constexpr std::string_view kAuto = "reduce";

void takes_nothing(const Choice& choice) {
  choice.takes_at_most(0);
}

constexpr std::array kStrategies{
    ExchangeStrategy{"auto", "by the cost model and what this machine was measured to do", false,
                     &exchange_reduce, &takes_nothing},
    ExchangeStrategy{"reduce", "owners fold their own voxels into exact partial sums; no voxel moves", false,
                     &exchange_reduce, &takes_nothing},
    ExchangeStrategy{"minimum",
                     "the responsible rank asks the owners for the voxels that it lacks, by coordinates",
                     true, &exchange_minimum, &takes_nothing},
    ExchangeStrategy{"block", "like minimum, with a block of B^3 voxels around each: block=B, 2 if left out",
                     true, &exchange_block, &check_block},
    ExchangeStrategy{"bounding",
                     "owners send all voxels in the bounding boxes of the faces, with coordinates", true,
                     &exchange_bounding, &takes_nothing},
    ExchangeStrategy{"push", "owners send the values that nobody had to ask for", true, &exchange_push,
                     &takes_nothing}};

}  // namespace

std::span<const ExchangeStrategy> exchange_strategies() {
  return kStrategies;
}

const ExchangeStrategy& exchange_strategy(std::string_view name) {
  const std::string_view wanted = name == "auto" ? kAuto : name;
  const auto* row = std::find_if(kStrategies.begin(), kStrategies.end(),
                                 [&](const ExchangeStrategy& s) { return s.name == wanted; });
  require(row != kStrategies.end() && row->run != nullptr, "an exchange strategy that was validated");
  return *row;
}

}  // namespace footwall::extract
