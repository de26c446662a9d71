#include "engine/extract/balance/local.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/extract/balance/start.h"
#include "storage/base/error.h"

namespace footwall::extract {
namespace {

bool knows_cache(const Choice& choice) {
  return choice.parameters.size() > 1 && choice.parameters[1] == "cache";
}

}  // namespace

std::vector<int> balance_local(const BalanceInput& input) {
  return balance_local(input, LocalMean::kFinal);
}

std::vector<int> balance_local(const BalanceInput& input, LocalMean which) {
  Start start = start_of(input);
  const int ranks = input.grid.ranks();
  const bool with_cache = knows_cache(input.choice) && input.cache != nullptr && !input.cache->empty();
  std::vector<FixedArea> loads(static_cast<std::size_t>(ranks), 0);
  FixedArea met = 0;
  for (std::size_t n = 0; n < start.areas.size(); ++n) {
    if (movable(input, n)) continue;
    loads[static_cast<std::size_t>(start.responsible[n])] += start.areas[n];
    met += start.areas[n];
  }
  const auto load_of = [&](int rank) { return loads[static_cast<std::size_t>(rank)]; };
  for (const std::uint32_t n : start.by_id) {
    if (!movable(input, n)) continue;
    const FixedArea area = start.areas[n];
    const FixedArea mean = which == LocalMean::kFinal ? start.mean : met / ranks;
    int& rank = start.responsible[n];
    if (area > 0 && load_of(rank) > mean + start.threshold) {
      const survey::Box box = voxel_box(input.faces[n]);
      int least = rank;
      const auto consider = [&](int other) {
        if (load_of(other) < load_of(least)) least = other;
      };
      if (with_cache) {
        const std::vector<int> near = ranks_meeting(input.grid, box);
        for (int other = 0; other < ranks; ++other) {
          if (std::binary_search(near.begin(), near.end(), other) || input.cache->holds(other, box)) {
            consider(other);
          }
        }
      } else {
        for (const int other : ranks_meeting(input.grid, box)) consider(other);
      }
      rank = least;
    }
    loads[static_cast<std::size_t>(rank)] += area;
    met += area;
  }
  return start.responsible;
}

void check_local(const Choice& choice) {
  choice.takes_at_most(2);
  threshold(choice);
  if (choice.parameters.size() > 1 && !knows_cache(choice)) {
    throw Error(ErrorCode::kUsage, fmt::format("'{}' is no parameter of 'local'", choice.parameters[1]),
                "write local=D or local=D,cache");
  }
}

}  // namespace footwall::extract
