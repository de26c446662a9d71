#include "engine/extract/balance/manhattan.h"

#include <algorithm>
#include <cstdlib>

#include "engine/extract/balance/start.h"

namespace footwall::extract {
namespace {

int reach_of(const Choice& choice) {
  constexpr int kInfinite = 1 << 30;
  return static_cast<int>(choice.whole(1, "distance of ranks", kInfinite, 1, kInfinite));
}

// Calls visit(rank) for the ranks at a Manhattan distance from `centre`, ascending, until it returns false.
template <class Visit>
bool each_of_ring(const comm::RankGrid& grid, int centre, int distance, Visit visit) {
  const auto [rows, columns] = grid.parts();
  const auto [row, column] = grid.place(centre);
  for (int a = std::max(0, row - distance); a <= std::min(rows - 1, row + distance); ++a) {
    const int aside = distance - std::abs(a - row);
    for (const int b : {column - aside, column + aside}) {
      if (b >= 0 && b < columns && !visit(a * columns + b)) return false;
      if (aside == 0) break;
    }
  }
  return true;
}

}  // namespace

std::vector<int> balance_manhattan(const BalanceInput& input) {
  Start start = start_of(input);
  std::vector<Stock> stocks = Stock::of_overloaded(input, start);
  const auto [rows, columns] = input.grid.parts();
  const int tau = std::min(reach_of(input.choice), rows - 1 + columns - 1);
  const FixedArea most = start.mean + start.threshold;

  for (int giver = 0; giver < input.grid.ranks(); ++giver) {
    if (!start.overloaded(giver)) continue;
    const auto at = static_cast<std::size_t>(giver);
    FixedArea surplus = start.loads[at] - most;
    const auto give_to = [&](int rank) {
      FixedArea& load = start.loads[static_cast<std::size_t>(rank)];
      if (load >= start.mean) return true;
      const FixedArea taken = stocks[at].take(std::min(surplus, most - load),
                                              [&](std::uint32_t face) { start.responsible[face] = rank; });
      load += taken;
      start.loads[at] -= taken;
      surplus -= taken;
      return surplus > 0;
    };
    for (int distance = 1; distance <= tau; ++distance) {
      if (!each_of_ring(input.grid, giver, distance, give_to)) break;
    }
  }
  return start.responsible;
}

void check_manhattan(const Choice& choice) {
  choice.takes_at_most(2);
  threshold(choice);
  reach_of(choice);
}

}  // namespace footwall::extract
