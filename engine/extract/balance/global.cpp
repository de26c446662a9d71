#include "engine/extract/balance/global.h"

#include <algorithm>

#include "engine/extract/balance/start.h"

namespace footwall::extract {

std::vector<int> balance_global(const BalanceInput& input) {
  Start start = start_of(input);
  std::vector<Stock> stocks = Stock::of_overloaded(input, start);
  using Receiver = std::pair<FixedArea, int>;  // load, rank
  std::vector<Receiver> receivers;             // those below the mean, by rising load
  for (int rank = 0; rank < input.grid.ranks(); ++rank) {
    const FixedArea load = start.loads[static_cast<std::size_t>(rank)];
    if (load < start.mean) receivers.emplace_back(load, rank);
  }
  std::sort(receivers.begin(), receivers.end());

  for (int giver = 0; giver < input.grid.ranks(); ++giver) {
    if (!start.overloaded(giver)) continue;
    const auto at = static_cast<std::size_t>(giver);
    FixedArea surplus = start.loads[at] - start.mean;
    auto visited = receivers.begin();
    for (; visited != receivers.end() && surplus > 0; ++visited) {
      auto& [load, rank] = *visited;
      const FixedArea taken =
          stocks[at].take(std::min(surplus, start.mean - load),
                          [&, to = rank](std::uint32_t face) { start.responsible[face] = to; });
      surplus -= taken;
      load += taken;
    }
    // Back in order for the next giver: only those visited have changed. A full one goes to the end for good.
    std::sort(receivers.begin(), visited);
    std::inplace_merge(receivers.begin(), visited, receivers.end());
    while (!receivers.empty() && receivers.back().first >= start.mean) receivers.pop_back();
  }
  return start.responsible;
}

void check_global(const Choice& choice) {
  choice.takes_at_most(1);
  threshold(choice);
}

}  // namespace footwall::extract
