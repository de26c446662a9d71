// The edges of a surface's triangles, each once.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/isosurface/surface.h"

namespace footwall::isosurface {

struct Edge {
  std::uint32_t a = 0;  // a < b
  std::uint32_t b = 0;
  std::uint32_t up = 0;    // triangles that run from a to b
  std::uint32_t down = 0;  // and from b to a
  bool boundary() const { return up + down == 1; }
  bool manifold() const { return up <= 1 && down <= 1; }
};

// Calls visit(Edge) for every edge, by ascending a, of equal a by ascending b. Takes room for three numbers a
// triangle and one a vertex.
template <class Visit>
void for_each_edge(const Surface& surface, Visit&& visit);

namespace detail {

// The upper end of each edge that starts at vertex a lies in ends[first[a]] .. ends[first[a + 1]]; bit 0
// tells whether the triangle runs downwards. Sorted for each a.
struct EdgeEnds {
  std::vector<std::uint64_t> first;
  std::vector<std::uint64_t> ends;  // 2 * b + down
};
EdgeEnds edge_ends_of(const Surface& surface);

}  // namespace detail

template <class Visit>
void for_each_edge(const Surface& surface, Visit&& visit) {
  const detail::EdgeEnds sorted = detail::edge_ends_of(surface);
  for (std::uint32_t a = 0; a + 1 < sorted.first.size(); ++a) {
    std::uint64_t n = sorted.first[a];
    while (n < sorted.first[a + 1]) {
      Edge edge{a, static_cast<std::uint32_t>(sorted.ends[n] >> 1)};
      for (; n < sorted.first[a + 1] && sorted.ends[n] >> 1 == edge.b; ++n) {
        ++((sorted.ends[n] & 1) == 0 ? edge.up : edge.down);
      }
      visit(edge);
    }
  }
}

}  // namespace footwall::isosurface
