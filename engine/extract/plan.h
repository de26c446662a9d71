// What the options of an extraction mean, looked up and checked once.
#pragma once
#include <vector>

#include "engine/extract/balance/balance.h"
#include "engine/extract/choice.h"
#include "engine/extract/computations.h"
#include "engine/extract/exchange/exchange.h"

namespace footwall::extract {

struct Plan {
  Options options;
  Choice exchange;
  Choice balance;
  const ExchangeStrategy* strategy = nullptr;  // the one that runs: never "auto"
  const BalanceStrategy* balancer = nullptr;
  std::vector<const Computation*> whole_face;
  bool with_discontinuity = false;
  double scale = 0;  // discontinuity_scale(); 0 without discontinuity
};

// max_abs: of the volume. Throws kUsage as validate() does.
Plan plan_of(const Options& options, double max_abs);
// For reports: as the options write it, and what runs in the place of "auto".
std::string name_of_exchange(const Plan& plan);

}  // namespace footwall::extract
