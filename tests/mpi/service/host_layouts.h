// Ranks dealt to hosts that are not there.
#pragma once
#include <vector>

namespace footwall::service {

// Of each rank, the lowest rank of its host: one host, two, one for every two ranks, one for each rank.
inline std::vector<std::vector<int>> host_layouts(int ranks) {
  std::vector<std::vector<int>> layouts(4);
  for (int rank = 0; rank < ranks; ++rank) {
    layouts[0].push_back(0);
    layouts[1].push_back(rank < (ranks + 1) / 2 ? 0 : (ranks + 1) / 2);
    layouts[2].push_back(rank % 2 == 1 ? rank - 1 : rank);
    layouts[3].push_back(rank);
  }
  return layouts;
}

}  // namespace footwall::service
