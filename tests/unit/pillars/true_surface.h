// Faults whose surface is known, with pillars picked on them.
#pragma once
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "engine/pillars/chart.h"

namespace footwall::pillars::testing {

// i = surface(j, k)
using Surface = std::function<double(double, double)>;

inline double planar(double j, double k) {
  return 60 + 0.3 * j + 0.6 * k;
}
inline double listric(double j, double k) {
  return 40 + 0.1 * j + 0.004 * k * k;
}
inline double twisted(double j, double k) {
  return 50 + 0.006 * (j - 60) * (k - 50);
}

// `count` pillars on crosslines j0, j0 + spacing ..., with `nodes` nodes from sample 5 to 95, moved by up to
// `jitter` voxels. Ids from 1, node ids 1000 * pillar + node.
inline std::vector<PillarInput> picked(const Surface& surface, int count, int nodes, double spacing,
                                       double jitter = 0, unsigned seed = 1) {
  std::mt19937 random(seed);
  auto noise = [&] { return jitter * (2.0 * double(random()) / double(random.max()) - 1); };
  std::vector<PillarInput> pillars;
  for (int p = 0; p < count; ++p) {
    PillarInput pillar{p + 1, fmt::format("P{}", p + 1), {}, {}};
    for (int n = 0; n < nodes; ++n) {
      const double j = 10 + p * spacing, k = nodes > 1 ? 5 + 90.0 * n / (nodes - 1) + noise() : 50;
      pillar.nodes.push_back({surface(j, k) + noise(), j, k});
      pillar.node_ids.push_back(1000 * (p + 1) + n);
    }
    pillars.push_back(pillar);
  }
  return pillars;
}

// A pillar picked on the time slice k.
inline PillarInput slice(const Surface& surface, std::int64_t id, double k, double from, double to, int nodes,
                         double shift = 0) {
  PillarInput pillar{id, fmt::format("T{}", id), {}, {}};
  for (int n = 0; n < nodes; ++n) {
    const double j = from + (to - from) * n / (nodes - 1);
    pillar.nodes.push_back({surface(j, k) + shift, j, k});
    pillar.node_ids.push_back(1000 * id + n);
  }
  return pillar;
}

}  // namespace footwall::pillars::testing
