// Many times of one thing.
#pragma once
#include <vector>

namespace footwall::tasks {

struct Spread {
  double median = 0;
  double p99 = 0;
  double most = 0;
  std::size_t times = 0;
};

// Throws Error kInternal for none.
Spread spread_of(std::vector<double> seconds);

}  // namespace footwall::tasks
