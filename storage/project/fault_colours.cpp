#include "storage/project/fault_colours.h"

#include <algorithm>
#include <array>

namespace footwall::project {
namespace {

// Okabe and Ito's set and three more, in an order in which neighbours differ in lightness as well as hue.
constexpr std::array<const char*, 10> kColours{"#e06c6c", "#4aa3df", "#e0b15c", "#2e8b57", "#c9a3e8",
                                               "#8c5a2b", "#56d0c0", "#d55e00", "#b0c4de", "#cc79a7"};

}  // namespace

FaultColours::FaultColours(std::span<const FaultRecord> faults) {
  for (const char* colour : kColours) uses_[colour] = 0;
  for (const FaultRecord& fault : faults) ++uses_[fault.colour];
}

std::string FaultColours::next() {
  const auto* least =
      std::ranges::min_element(kColours, {}, [this](const char* colour) { return uses_.at(colour); });
  ++uses_.at(*least);
  return *least;
}

}  // namespace footwall::project
