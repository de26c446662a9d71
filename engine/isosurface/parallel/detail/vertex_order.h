// The order of vertices in a surface, as a number made from the key.
#pragma once
#include <cstdint>

#include "engine/isosurface/parallel/pillars.h"
#include "engine/isosurface/surface.h"

namespace footwall::isosurface::detail {

// Where a vertex stands: vertices on k edges come first in their row, then those on j edges, on i edges, and
// centres; vertices of caps, which stand on samples, come after all others (cap.h).
class VertexOrder {
 public:
  static constexpr VertexKey kOnSample = VertexKey{1} << 63;

  explicit VertexOrder(const Pillars& pillars)
      : pillars_(pillars),
        rows_(static_cast<std::uint64_t>(pillars.volume()[0] * pillars.volume()[1])),
        samples_(static_cast<std::uint64_t>(pillars.volume()[2])),
        crosslines_(static_cast<std::uint64_t>(pillars.volume()[1])),
        layers_(static_cast<std::uint64_t>(pillars.layers())) {}

  struct Place {
    survey::Index sample{0, 0, 0};
    std::uint64_t order = 0;
  };
  Place of(VertexKey key) const {
    const bool on_sample = (key & kOnSample) != 0;
    const std::uint64_t number = on_sample ? key & ~kOnSample : key >> 2;
    const std::uint64_t row = number / samples_;
    const std::uint64_t k = number - row * samples_;
    const std::uint64_t i = row / crosslines_;
    // Axes 2, 1, 0, and the centres.
    constexpr std::uint64_t kKind[4] = {2, 1, 0, 3};
    const std::uint64_t line = on_sample ? 4 * rows_ + row : 4 * row + kKind[key & 3];
    return {{static_cast<std::int64_t>(i), static_cast<std::int64_t>(row - i * crosslines_),
             static_cast<std::int64_t>(k)},
            line * samples_ + k};
  }
  // Vertices of one slot belong to one rank; slots ascend with the order.
  std::uint64_t slot(const Place& place) const {
    const std::uint64_t line = place.order / samples_;
    return line * layers_ + static_cast<std::uint64_t>(pillars_.layer(pillars_.cell_of(place.sample)[2]));
  }
  std::uint64_t slots() const { return 5 * rows_ * layers_; }

 private:
  const Pillars& pillars_;
  std::uint64_t rows_;
  std::uint64_t samples_;
  std::uint64_t crosslines_;
  std::uint64_t layers_;
};

}  // namespace footwall::isosurface::detail
