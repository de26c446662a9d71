// Segments between numbered points, joined into chains.
#pragma once
#include <cstddef>
#include <vector>

namespace footwall::formats::detail {

struct Segment {
  std::size_t a, b;  // numbers of points, a != b
};

// Chains of point numbers that use each segment once (one that is there twice counts once). A chain ends
// where a point has other than two segments; closed chains repeat their first point. Open chains come first,
// in the order of their lowest ends, from which they run; then closed ones, from their lowest point along the
// segment that comes first; then each point of [first, last) without a segment, as a chain of one.
std::vector<std::vector<std::size_t>> line_chains(std::size_t first, std::size_t last,
                                                  std::vector<Segment> segments);

}  // namespace footwall::formats::detail
