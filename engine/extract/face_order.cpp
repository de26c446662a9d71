#include "engine/extract/face_order.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "storage/base/error.h"

namespace footwall::extract {
namespace {

// Of a cell's number on an axis. More cells than a cache holds counters for would cost more than they bring.
constexpr int kMostBits = 6;

// The lowest six bits, two zeros behind each.
std::uint32_t spread(std::uint32_t x) {
  x = (x | (x << 8)) & 0x0300f00fu;
  x = (x | (x << 4)) & 0x030c30c3u;
  return (x | (x << 2)) & 0x09249249u;
}

// Three times the centroid.
std::array<std::int64_t, 3> place_of(const Face& face) {
  std::array<std::int64_t, 3> sum{};
  for (const survey::LatticePoint& p : face.triangle) {
    sum[0] += p.i;
    sum[1] += p.j;
    sum[2] += p.k;
  }
  return sum;
}

}  // namespace

void FaceOrder::of(std::span<const Face> faces) {
  require(faces.size() < std::numeric_limits<std::uint32_t>::max(), "faces that have numbers of 32 bits");
  order_.resize(faces.size());
  if (faces.size() < kFewFaces) {
    std::iota(order_.begin(), order_.end(), 0u);
    return;
  }
  std::array<std::int64_t, 3> least;
  least.fill(std::numeric_limits<std::int64_t>::max());
  std::array<std::int64_t, 3> most;
  most.fill(std::numeric_limits<std::int64_t>::min());
  for (const Face& face : faces) {
    const auto place = place_of(face);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      least[axis] = std::min(least[axis], place[axis]);
      most[axis] = std::max(most[axis], place[axis]);
    }
  }
  int bits = 1;
  while (bits < kMostBits && (std::size_t{1} << (3 * (bits + 1))) <= 2 * faces.size()) ++bits;
  std::int64_t extent = 0;  // one for all axes, so that the cells are cubes
  for (std::size_t axis = 0; axis < 3; ++axis) extent = std::max(extent, most[axis] - least[axis]);
  const double cells =
      static_cast<double>((1 << bits) - 1) / static_cast<double>(std::max<std::int64_t>(1, extent));

  cell_of_face_.resize(faces.size());
  next_of_cell_.assign((std::size_t{1} << (3 * bits)) + 1, 0);
  for (std::size_t n = 0; n < faces.size(); ++n) {
    const auto place = place_of(faces[n]);
    std::uint32_t cell = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto at = static_cast<std::uint32_t>(static_cast<double>(place[axis] - least[axis]) * cells);
      cell |= spread(at) << (2 - axis);
    }
    cell_of_face_[n] = cell;
    ++next_of_cell_[cell + 1];
  }
  std::partial_sum(next_of_cell_.begin(), next_of_cell_.end(), next_of_cell_.begin());
  for (std::size_t n = 0; n < faces.size(); ++n)
    order_[next_of_cell_[cell_of_face_[n]]++] = static_cast<std::uint32_t>(n);
}

}  // namespace footwall::extract
