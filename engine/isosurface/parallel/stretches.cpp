#include "engine/isosurface/parallel/detail/stretches.h"

#include <algorithm>
#include <tuple>

#include "engine/isosurface/parallel/detail/vertex_order.h"
#include "storage/base/error.h"

namespace footwall::isosurface::detail {
namespace {

std::uint64_t slot_of(const Pillars& pillars, const survey::Index& cell) {
  return static_cast<std::uint64_t>((cell[0] * pillars.volume()[1] + cell[1]) * pillars.layers() +
                                    pillars.layer(cell[2]));
}

// A triangle of a cap lies in one square on a face of the volume: the square's cell, and which face.
struct Square {
  survey::Index cell{0, 0, 0};
  int face = 0;  // 2 * axis + side
};

Square square_of(const Pillars& pillars, const VertexOrder& order, const Surface& surface,
                 const Triangle& triangle) {
  survey::Index lo{0, 0, 0};
  survey::Index hi = pillars.volume();
  std::array<bool, 3> flat{true, true, true};  // all three vertices on one plane of samples
  std::array<std::int64_t, 3> plane{-1, -1, -1};
  for (const std::uint32_t vertex : triangle) {
    const VertexKey key = surface.keys[vertex];
    const survey::Index sample = order.of(key).sample;
    const bool on_sample = (key & VertexOrder::kOnSample) != 0;
    for (int axis = 0; axis < 3; ++axis) {
      const bool along = !on_sample && static_cast<int>(key & 3) == axis;
      lo[axis] = std::max(lo[axis], along ? sample[axis] : sample[axis] - 1);
      hi[axis] = std::min(hi[axis], sample[axis] + 1);
      flat[axis] = flat[axis] && !along && (plane[axis] < 0 || plane[axis] == sample[axis]);
      plane[axis] = sample[axis];
    }
  }
  Square square;
  bool found = false;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t last = pillars.volume()[axis] - 1;
    square.cell[axis] = std::min(lo[axis], last - 1);
    if (!found && flat[axis] && (plane[axis] == 0 || plane[axis] == last)) {
      square.face = 2 * axis + (plane[axis] == 0 ? 0 : 1);
      found = true;
    }
  }
  return square;
}

struct CapTriangle {
  Stretch stretch;
  std::int64_t k = 0;
  int face = 0;
};

void add_caps(const Pillars& pillars, std::span<const Piece> pieces, std::vector<Stretch>& stretches) {
  const VertexOrder order(pillars);
  const std::uint64_t after = triangle_slots(pillars) / 2;
  std::vector<CapTriangle> caps;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const Surface& surface = pieces[p].surface;
    const std::uint64_t own = surface.row_first.empty() ? 0 : surface.row_first.back();
    for (std::uint64_t n = own; n < surface.triangles.size(); ++n) {
      const Square square = square_of(pillars, order, surface, surface.triangles[n]);
      caps.push_back(
          {{{after + slot_of(pillars, square.cell), 1, 0}, static_cast<std::uint32_t>(p), kNoRow, n},
           square.cell[2],
           square.face});
    }
  }
  std::stable_sort(caps.begin(), caps.end(), [](const CapTriangle& a, const CapTriangle& b) {
    return std::tie(a.stretch.run.slot, a.k, a.face) < std::tie(b.stretch.run.slot, b.k, b.face);
  });
  for (const CapTriangle& cap : caps) stretches.push_back(cap.stretch);
}

}  // namespace

std::uint64_t triangle_slots(const Pillars& pillars) {
  return static_cast<std::uint64_t>(2 * pillars.volume()[0] * pillars.volume()[1] * pillars.layers());
}

std::vector<Stretch> stretches_of(const Pillars& pillars, std::span<const Piece> pieces) {
  std::vector<Stretch> stretches;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const Surface& surface = pieces[p].surface;
    const survey::Box& cells = surface.cells;
    require(surface.row_first.size() == static_cast<std::size_t>(cells.size(0) * cells.size(1) + 1),
            "a piece counts the triangles of each row");
    std::uint32_t row = 0;
    for (std::int64_t i = cells.lo[0]; i < cells.hi[0]; ++i) {
      for (std::int64_t j = cells.lo[1]; j < cells.hi[1]; ++j, ++row) {
        const std::uint64_t first = surface.row_first[row];
        const auto count = static_cast<std::uint32_t>(surface.row_first[row + 1] - first);
        if (count == 0) continue;
        stretches.push_back(
            {{slot_of(pillars, {i, j, cells.lo[2]}), count, 0}, static_cast<std::uint32_t>(p), row, first});
      }
    }
  }
  std::stable_sort(stretches.begin(), stretches.end(), [&](const Stretch& a, const Stretch& b) {
    if (a.run.slot != b.run.slot) return a.run.slot < b.run.slot;
    return pieces[a.piece].surface.cells.lo[2] < pieces[b.piece].surface.cells.lo[2];
  });
  add_caps(pillars, pieces, stretches);
  return stretches;
}

}  // namespace footwall::isosurface::detail
