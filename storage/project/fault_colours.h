// Colours for new faults, from a set that differs in lightness as well as in hue.
#pragma once
#include <map>
#include <span>
#include <string>

#include "storage/project/records.h"

namespace footwall::project {

// Hands out the colour that fewest faults have, the first of the set among equals.
class FaultColours {
 public:
  explicit FaultColours(std::span<const FaultRecord> faults);
  // "#rrggbb"; counts as given to a fault.
  std::string next();

 private:
  std::map<std::string, int> uses_;
};

}  // namespace footwall::project
