#include "engine/extract/balance/start.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "engine/extract/balance/none.h"
#include "engine/voxelize/exact.h"
#include "storage/base/error.h"

namespace footwall::extract {

std::vector<std::uint32_t> by_id(std::span<const Face> faces) {
  require(faces.size() < std::numeric_limits<std::uint32_t>::max(), "fewer than 2^32 faces");
  std::vector<std::uint32_t> order(faces.size());
  std::iota(order.begin(), order.end(), std::uint32_t{0});
  const auto before = [&](std::uint32_t a, std::uint32_t b) { return id_of(faces[a]) < id_of(faces[b]); };
  if (!std::is_sorted(order.begin(), order.end(), before)) {
    std::stable_sort(order.begin(), order.end(), before);
  }
  return order;
}

std::vector<int> starting_ranks(const BalanceInput& input) {
  std::vector<int> ranks(input.faces.size());
  starting_ranks(input, 0, ranks);
  return ranks;
}

void starting_ranks(const BalanceInput& input, std::size_t first, std::span<int> part) {
  require(input.previous.empty() || input.previous.size() == input.faces.size(),
          "a previous rank for every face");
  for (std::size_t m = 0; m < part.size(); ++m) {
    const std::size_t n = first + m;
    int& rank = part[m];
    if (!movable(input, n)) {
      require(input.previous[n] < input.grid.ranks(), "a previous rank of the grid");
      rank = input.previous[n];
    } else {
      rank = centroid_rank(input.faces[n].triangle, input.grid);
    }
  }
}

FixedArea threshold(const Choice& choice) {
  constexpr double kMost = 1e12;
  const double d = choice.number(0, "threshold in voxel^2", 0, 0, kMost);
  // Exact: a power of two times a number, then a whole number.
  return static_cast<FixedArea>(std::floor(d * static_cast<double>(kAreaPerVoxel2)));
}

Start start_of(const BalanceInput& input) {
  Start start;
  start.areas = fixed_areas(input.faces);
  start.responsible = starting_ranks(input);
  start.by_id = by_id(input.faces);
  start.loads = loads_of(start.areas, start.responsible, input.grid.ranks());
  start.mean = std::accumulate(start.loads.begin(), start.loads.end(), FixedArea{0}) / input.grid.ranks();
  start.threshold = threshold(input.choice);
  return start;
}

survey::Box voxel_box(const Face& face) {
  return voxelize::bounding_voxels(face.triangle);
}

std::vector<int> ranks_meeting(const comm::RankGrid& grid, const survey::Box& box) {
  const survey::Box inside = survey::intersection(box, {{0, 0, 0}, grid.dims()});
  if (inside.empty()) return {};
  // The places along each axis whose lines the box has; pillars are dealt out in turn.
  std::array<std::vector<int>, 2> places;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const std::int64_t first = inside.lo[axis] / grid.lines()[axis];
    const std::int64_t last = (inside.hi[axis] - 1) / grid.lines()[axis];
    const int parts = grid.parts()[axis];
    for (std::int64_t pillar = first; pillar <= std::min(last, first + parts - 1); ++pillar) {
      places[axis].push_back(static_cast<int>(pillar % parts));
    }
    std::sort(places[axis].begin(), places[axis].end());
  }
  std::vector<int> ranks;
  for (const int a : places[0]) {
    for (const int b : places[1]) ranks.push_back(a * grid.parts()[1] + b);
  }
  return ranks;
}

std::vector<Stock> Stock::of_overloaded(const BalanceInput& input, const Start& start) {
  std::vector<Stock> stocks(start.loads.size());
  for (const std::uint32_t n : start.by_id) {
    const int rank = start.responsible[n];
    if (start.overloaded(rank) && start.areas[n] > 0 && movable(input, n)) {
      stocks[static_cast<std::size_t>(rank)].faces_.emplace_back(start.areas[n], n);
    }
  }
  for (Stock& stock : stocks) {
    std::stable_sort(stock.faces_.begin(), stock.faces_.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    stock.next_.resize(stock.faces_.size() + 1);
    std::iota(stock.next_.begin(), stock.next_.end(), std::uint32_t{0});
  }
  return stocks;
}

std::size_t Stock::present(std::size_t n) {
  while (next_[n] != n) {
    next_[n] = next_[next_[n]];  // halves the way for the next one who asks
    n = next_[n];
  }
  return n;
}

std::size_t Stock::fitting(std::size_t from, FixedArea room) {
  if (from < faces_.size() && faces_[from].first > room) {
    const auto first = std::partition_point(faces_.begin() + static_cast<std::ptrdiff_t>(from), faces_.end(),
                                            [&](const auto& face) { return face.first > room; });
    from = static_cast<std::size_t>(first - faces_.begin());
  }
  return present(from);
}

}  // namespace footwall::extract
