#include "engine/comm/rank_grid.h"

#include <cstdlib>
#include <tuple>

#include "storage/base/error.h"

namespace footwall::comm {

RankGrid::RankGrid(const survey::Index& dims, int ranks, std::array<int, 2> pillars)
    : dims_(dims), pillars_(pillars) {
  require(ranks >= 1 && dims[0] >= 1 && dims[1] >= 1 && dims[2] >= 1, "at least one rank and one voxel");
  require(pillars[0] >= 1 && pillars[1] >= 1, "at least one pillar for each rank");
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
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const std::int64_t pieces = std::int64_t{parts_[axis]} * pillars_[axis];
    lines_[axis] = (dims[axis] + pieces - 1) / pieces;
  }
}

std::vector<survey::Box> RankGrid::boxes(int rank) const {
  require(rank >= 0 && rank < ranks(), "a rank of the grid");
  const std::array<int, 2> at = place(rank);
  std::vector<survey::Box> boxes;
  for (int m = 0; m < pillars_[0]; ++m) {
    for (int n = 0; n < pillars_[1]; ++n) {
      const std::array<std::int64_t, 2> pillar{at[0] + std::int64_t{m} * parts_[0],
                                               at[1] + std::int64_t{n} * parts_[1]};
      survey::Box box{{0, 0, 0}, dims_};
      for (std::size_t axis = 0; axis < 2; ++axis) {
        box.lo[axis] = std::min(pillar[axis] * lines_[axis], dims_[axis]);
        box.hi[axis] = std::min(box.lo[axis] + lines_[axis], dims_[axis]);
      }
      if (!box.empty()) boxes.push_back(box);
    }
  }
  return boxes;
}

survey::Box RankGrid::box(int rank) const {
  require(pillars_[0] == 1 && pillars_[1] == 1, "a plain decomposition");
  const std::vector<survey::Box> boxes = this->boxes(rank);
  return boxes.empty() ? survey::Box{dims_, dims_} : boxes.front();
}

int RankGrid::distance(int one, int other) const {
  const std::array<int, 2> a = place(one);
  const std::array<int, 2> b = place(other);
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]);
}

}  // namespace footwall::comm
