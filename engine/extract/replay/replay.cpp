#include "engine/extract/replay/replay.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

#include "engine/voxelize/exact.h"
#include "storage/base/error.h"

namespace footwall::extract {
namespace {

// Counts a face's voxels by owner.
class OwnerCounts final : public voxelize::RowSink {
 public:
  explicit OwnerCounts(const comm::RankGrid& grid)
      : columns_(grid.parts()[1]), counts_(static_cast<std::size_t>(grid.ranks()), 0) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const std::int64_t lines = grid.lines()[axis];
      for (std::int64_t line = 0; line < grid.dims()[axis]; ++line) {
        place_[axis].push_back(static_cast<int>(line / lines) % grid.parts()[axis]);
        end_[axis].push_back(std::min((line / lines + 1) * lines, grid.dims()[axis]) - 1);
      }
    }
  }

  void row(const voxelize::Row& row) override {
    if (row.w_axis == 2) {
      along_samples(row);
    } else {
      across_traces(row);
    }
  }

  // The pieces of the face since the last call, by owner.
  void take(std::int32_t face, std::vector<Piece>& pieces) {
    std::sort(touched_.begin(), touched_.end());
    for (const int rank : touched_) {
      std::int64_t& count = counts_[static_cast<std::size_t>(rank)];
      pieces.push_back({face, rank, count});
      count = 0;
    }
    touched_.clear();
  }

 private:
  void add(int rank, std::int64_t voxels) {
    std::int64_t& count = counts_[static_cast<std::size_t>(rank)];
    if (count == 0) touched_.push_back(rank);
    count += voxels;
  }
  int rank_at(int axis, std::int64_t along, std::int64_t across) const {
    const int one = place_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(along)];
    const int other = place_[static_cast<std::size_t>(1 - axis)][static_cast<std::size_t>(across)];
    return axis == 0 ? one * columns_ + other : other * columns_ + one;
  }

  void along_samples(const voxelize::Row& row) {
    const auto u = static_cast<std::size_t>(row.u_axis);
    std::size_t n = 0;
    while (n < row.lo.size()) {
      const std::int64_t line = row.u0 + static_cast<std::int64_t>(n);
      const std::int64_t stop = std::min(end_[u][static_cast<std::size_t>(line)] - row.u0 + 1,
                                         static_cast<std::int64_t>(row.lo.size()));
      const std::size_t length = static_cast<std::size_t>(stop) - n;
      voxelize::Row part = row;
      part.lo = row.lo.subspan(n, length);
      part.hi = row.hi.subspan(n, length);
      if (const std::int64_t voxels = voxelize::voxels_in(part); voxels > 0)
        add(rank_at(row.u_axis, line, row.v), voxels);
      n = static_cast<std::size_t>(stop);
    }
  }

  void across_traces(const voxelize::Row& row) {
    const auto w = static_cast<std::size_t>(row.w_axis);
    // Spans are short, and neighbours mostly belong to the same rank: counted together until that changes.
    int rank = -1;
    std::int64_t pending = 0;
    std::int64_t begin = 0;  // of the lines that `rank` has here
    std::int64_t end = -1;
    for (std::size_t n = 0; n < row.lo.size(); ++n) {
      for (std::int64_t at = row.lo[n]; at <= row.hi[n];) {
        if (at < begin || at > end) {
          if (pending > 0) add(rank, pending);
          pending = 0;
          rank = rank_at(row.w_axis, at, row.v);
          begin = at;
          end = end_[w][static_cast<std::size_t>(at)];
        }
        const std::int64_t last = std::min<std::int64_t>(row.hi[n], end);
        pending += last - at + 1;
        at = last + 1;
      }
    }
    if (pending > 0) add(rank, pending);
  }

  int columns_;
  std::array<std::vector<int>, 2> place_;         // rank coordinate of each line
  std::array<std::vector<std::int64_t>, 2> end_;  // last line of its pillar
  std::vector<std::int64_t> counts_;
  std::vector<int> touched_;
};

double max_over_mean(const std::vector<std::int64_t>& loads) {
  double total = 0;
  for (const std::int64_t load : loads) total += static_cast<double>(load);
  if (total <= 0) return 1;
  return static_cast<double>(*std::max_element(loads.begin(), loads.end())) *
         static_cast<double>(loads.size()) / total;
}

void check(const comm::RankGrid& grid, std::span<const Face> faces, const Pieces& pieces,
           std::span<const int> responsible) {
  require(responsible.size() == faces.size() && pieces.first.size() == faces.size() + 1,
          "pieces and a rank for every face");
  require(std::all_of(responsible.begin(), responsible.end(),
                      [&](int rank) { return rank >= 0 && rank < grid.ranks(); }),
          "ranks of the grid");
}

}  // namespace

Pieces pieces_of(const comm::RankGrid& grid, std::span<const Face> faces, const JobContext& job) {
  require(faces.size() <= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()),
          "fewer than 2^31 faces");
  Pieces pieces;
  voxelize::ExactScratch scratch;
  OwnerCounts counts(grid);
  const survey::Box survey{{0, 0, 0}, grid.dims()};
  pieces.first.push_back(0);
  for (std::size_t n = 0; n < faces.size(); ++n) {
    if (n % 1024 == 0) job.check();
    voxelize::exact_rows(faces[n].triangle, survey, scratch, counts);
    counts.take(static_cast<std::int32_t>(n), pieces.all);
    std::int64_t voxels = 0;
    for (std::size_t p = pieces.first.back(); p < pieces.all.size(); ++p) voxels += pieces.all[p].voxels;
    pieces.voxels.push_back(voxels);
    pieces.first.push_back(pieces.all.size());
  }
  return pieces;
}

Amounts amounts_of(const comm::RankGrid& grid, std::span<const Face> faces, const Pieces& pieces,
                   std::span<const int> responsible) {
  check(grid, faces, pieces, responsible);
  Amounts amounts;
  amounts.ranks = grid.ranks();
  amounts.area = loads_of(fixed_areas(faces), responsible, grid.ranks());
  amounts.voxels.assign(static_cast<std::size_t>(grid.ranks()), 0);
  amounts.owned.assign(static_cast<std::size_t>(grid.ranks()), 0);
  for (const Piece& piece : pieces.all) {
    const int to = responsible[static_cast<std::size_t>(piece.face)];
    amounts.voxels[static_cast<std::size_t>(to)] += piece.voxels;
    amounts.owned[static_cast<std::size_t>(piece.owner)] += piece.voxels;
    if (piece.owner == to) continue;
    amounts.remote += piece.voxels;
    amounts.pairs.push_back({piece.owner, to, piece.voxels, 1});
  }
  std::sort(amounts.pairs.begin(), amounts.pairs.end(),
            [](const Pair& a, const Pair& b) { return std::tie(a.from, a.to) < std::tie(b.from, b.to); });
  std::size_t kept = 0;
  for (const Pair& pair : amounts.pairs) {
    if (kept > 0 && amounts.pairs[kept - 1].from == pair.from && amounts.pairs[kept - 1].to == pair.to) {
      amounts.pairs[kept - 1].voxels += pair.voxels;
      ++amounts.pairs[kept - 1].pieces;
    } else {
      amounts.pairs[kept++] = pair;
    }
  }
  amounts.pairs.resize(kept);
  amounts.area_deviation = load_deviation(amounts.area);
  amounts.area_max_over_mean = max_over_mean(amounts.area);
  amounts.voxels_max_over_mean = max_over_mean(amounts.voxels);
  amounts.owned_max_over_mean = max_over_mean(amounts.owned);
  return amounts;
}

Predicted predict(const Amounts& amounts, const Sent& sent, const MachineCosts& costs) {
  const std::vector<std::int64_t>& walked = sent.at_owners ? amounts.owned : amounts.voxels;
  const std::int64_t most = walked.empty() ? 0 : *std::max_element(walked.begin(), walked.end());
  return {static_cast<double>(most) * costs.voxel, sent.busiest(costs)};
}

}  // namespace footwall::extract
