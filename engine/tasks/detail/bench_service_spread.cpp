#include "engine/tasks/detail/bench_service_spread.h"

#include <algorithm>
#include <cmath>

#include "storage/base/error.h"

namespace footwall::tasks {

Spread spread_of(std::vector<double> seconds) {
  require(!seconds.empty(), "times to look at");
  std::sort(seconds.begin(), seconds.end());
  // The least that so many are not above.
  const auto at = [&](double share) {
    const double place = std::ceil(share * static_cast<double>(seconds.size()));
    return seconds[static_cast<std::size_t>(std::max(1.0, place)) - 1];
  };
  return {at(0.5), at(0.99), seconds.back(), seconds.size()};
}

}  // namespace footwall::tasks
