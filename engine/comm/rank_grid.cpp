#include "engine/comm/rank_grid.h"

#include <tuple>

#include "storage/base/error.h"

namespace footwall::comm {

RankGrid::RankGrid(const survey::Index& dims, int ranks) : dims_(dims) {
  require(ranks >= 1 && dims[0] >= 1 && dims[1] >= 1 && dims[2] >= 1, "at least one rank and one voxel");
  using Cost = std::tuple<std::int64_t, std::int64_t, int>;  // traces, border, ranks along inlines
  bool first = true;
  Cost best{};
  for (int a = 1; a <= ranks; ++a) {
    if (ranks % a != 0) continue;
    const int b = ranks / a;
    const std::int64_t rows = (dims[0] + a - 1) / a;
    const std::int64_t columns = (dims[1] + b - 1) / b;
    const Cost cost{rows * columns, rows + columns, a};
    if (!first && !(cost < best)) continue;
    first = false;
    best = cost;
    parts_ = {a, b};
    lines_ = {rows, columns};
  }
}

survey::Box RankGrid::box(int rank) const {
  require(rank >= 0 && rank < ranks(), "a rank of the grid");
  const std::int64_t place[2] = {rank / parts_[1], rank % parts_[1]};
  survey::Box box{{0, 0, 0}, dims_};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    box.lo[axis] = std::min(place[axis] * lines_[axis], dims_[axis]);
    box.hi[axis] = std::min(box.lo[axis] + lines_[axis], dims_[axis]);
  }
  return box;
}

}  // namespace footwall::comm
