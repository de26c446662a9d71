#include "engine/isosurface/parallel/choose_pillars.h"

#include <algorithm>
#include <array>
#include <vector>

#include "engine/isosurface/parallel/active_blocks.h"

namespace footwall::isosurface {
namespace {

constexpr std::int64_t kBrick = 8;
// A surface that crosses a brick of 8 x 8 x 8 cells crosses some 1.5 x 8 x 8 of them, and a cell with
// triangles costs some 40 times one without: comparing a sample takes a fraction of a nanosecond, a vertex
// with its normal some 20 ns.
constexpr double kActiveCells = 96;
constexpr double kActiveCost = 40;
constexpr int kMostInterleaving = 8;
constexpr double kAboutEqual = 1.02;

// A piece of an axis and how much of a brick's extent lies in it.
struct Share {
  int part = 0;
  double fraction = 0;
  double vertices = 1;  // computed for each that is needed: those on the cut are computed on both sides
  double samples = 1;   // stored for each cell
};

// By brick along an axis of `cells` that is cut into `parts`.
std::vector<std::vector<Share>> shares_of(std::int64_t cells, std::int64_t parts, std::int64_t bricks,
                                          bool normals) {
  std::vector<std::vector<Share>> shares(static_cast<std::size_t>(bricks));
  for (std::int64_t part = 0; part < parts; ++part) {
    const std::int64_t first = cells * part / parts;
    const std::int64_t end = cells * (part + 1) / parts;
    const auto width = static_cast<double>(end - first);
    const double halo = parts == 1 ? 0 : normals ? 3 : 1;
    for (std::int64_t brick = first / kBrick; brick * kBrick < end; ++brick) {
      const std::int64_t lo = std::max(first, brick * kBrick);
      const std::int64_t hi = std::min(end, (brick + 1) * kBrick);
      const std::int64_t whole = std::min(cells, (brick + 1) * kBrick) - brick * kBrick;
      shares[static_cast<std::size_t>(brick)].push_back(
          {static_cast<int>(part), static_cast<double>(hi - lo) / static_cast<double>(whole),
           1 + (parts == 1 ? 0 : 1 / width), 1 + halo / width});
    }
  }
  return shares;
}

}  // namespace

WorkForecast forecast(const Pillars& pillars, const Bricks& bricks, float isovalue, bool normals) {
  std::array<std::vector<std::vector<Share>>, 3> shares;
  const std::array<std::int64_t, 3> parts{std::int64_t{pillars.grid()[0]} * pillars.interleaving()[0],
                                          std::int64_t{pillars.grid()[1]} * pillars.interleaving()[1],
                                          pillars.layers()};
  for (int axis = 0; axis < 3; ++axis)
    shares[axis] = shares_of(pillars.volume()[axis] - 1, parts[axis], bricks.dims[axis], normals);
  std::vector<double> load(static_cast<std::size_t>(pillars.ranks()), 0);
  WorkForecast forecast;
  const auto of_brick = [](const std::vector<std::vector<Share>>& of_axis, std::int64_t brick) {
    return std::span(of_axis[static_cast<std::size_t>(brick)]);
  };
  constexpr double kCells = kBrick * kBrick * kBrick;
  for (std::int64_t a = 0; a < bricks.dims[0]; ++a) {
    for (std::int64_t b = 0; b < bricks.dims[1]; ++b) {
      for (std::int64_t c = 0; c < bricks.dims[2]; ++c) {
        if (!is_active(bricks, {a, b, c}, isovalue)) continue;
        for (const Share& i : of_brick(shares[0], a)) {
          for (const Share& j : of_brick(shares[1], b)) {
            for (const Share& k : of_brick(shares[2], c)) {
              const double fraction = i.fraction * j.fraction * k.fraction;
              const double needed = fraction * (kCells + kActiveCells * kActiveCost);
              const double done =
                  fraction * (kCells * i.samples * j.samples * k.samples +
                              kActiveCells * kActiveCost * i.vertices * j.vertices * k.vertices);
              load[static_cast<std::size_t>(pillars.rank_of({i.part, j.part, k.part}))] += done;
              forecast.redundant += done - needed;
              forecast.mean += done;
            }
          }
        }
      }
    }
  }
  forecast.mean /= static_cast<double>(load.size());
  forecast.slowest = *std::max_element(load.begin(), load.end());
  return forecast;
}

Interleaving choose_interleaving(const survey::Index& volume, int ranks, const Bricks& bricks, float isovalue,
                                 bool normals) {
  Interleaving best{1, 1, 1};
  const bool has_cells = volume[0] > 1 && volume[1] > 1 && volume[2] > 1;
  if (ranks == 1 || !has_cells) return best;
  const auto pillars_in = [](const Interleaving& one) { return one[0] * one[1] * one[2]; };
  double least = -1;
  for (const int layers : {1, 2, 4}) {
    for (int a = 1; a <= kMostInterleaving; ++a) {
      for (int b = 1; b <= kMostInterleaving; ++b) {
        const Interleaving one{a, b, layers};
        const double slowest = forecast(Pillars(volume, ranks, one), bricks, isovalue, normals).slowest;
        const bool fewer = pillars_in(one) < pillars_in(best);
        if (least < 0 || slowest * kAboutEqual < least || (fewer && slowest <= least * kAboutEqual)) {
          best = one;
          least = least < 0 ? slowest : std::min(least, slowest);
        }
      }
    }
  }
  return best;
}

}  // namespace footwall::isosurface
