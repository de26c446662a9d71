#include "engine/isosurface/parallel/choose_pillars.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "engine/isosurface/parallel/active_blocks.h"

namespace footwall::isosurface {
namespace {

constexpr std::int64_t kBrick = 8;
// In units of a cell that is looked at and holds nothing, some 0.5 ns (measured with `bench isosurface
// --ranks`): a surface that crosses a brick of 8 x 8 x 8 cells crosses some 1.5 x 8 x 8 of them, a cell with
// triangles takes some 100 ns with its vertex and normal, and a pillar some 6 us of its own.
constexpr double kActiveCells = 96;
constexpr double kActiveCost = 200;
constexpr double kPillarCost = 12000;
constexpr int kMostInterleaving = 8;
constexpr double kAboutEqual = 1.05;

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

// At most so many bricks are looked at for each of the 192 interleavings: every nth of the active ones.
constexpr std::size_t kMostBricks = std::size_t{1} << 16;

std::vector<survey::Index> active_bricks(const Bricks& bricks, float isovalue) {
  std::vector<survey::Index> active;
  for (std::int64_t a = 0; a < bricks.dims[0]; ++a) {
    for (std::int64_t b = 0; b < bricks.dims[1]; ++b) {
      for (std::int64_t c = 0; c < bricks.dims[2]; ++c) {
        if (is_active(bricks, {a, b, c}, isovalue)) active.push_back({a, b, c});
      }
    }
  }
  return active;
}

WorkForecast forecast_of(const Pillars& pillars, const survey::Index& dims,
                         std::span<const survey::Index> active, bool normals) {
  std::array<std::vector<std::vector<Share>>, 3> shares;
  const std::array<std::int64_t, 3> parts{std::int64_t{pillars.grid()[0]} * pillars.interleaving()[0],
                                          std::int64_t{pillars.grid()[1]} * pillars.interleaving()[1],
                                          pillars.layers()};
  for (int axis = 0; axis < 3; ++axis)
    shares[axis] = shares_of(pillars.volume()[axis] - 1, parts[axis], dims[axis], normals);
  std::vector<double> load(static_cast<std::size_t>(pillars.ranks()), 0);
  std::vector<std::uint8_t> begun(static_cast<std::size_t>(parts[0] * parts[1] * parts[2]), 0);
  WorkForecast forecast;
  constexpr double kCells = kBrick * kBrick * kBrick;
  for (const survey::Index& brick : active) {
    for (const Share& i : shares[0][static_cast<std::size_t>(brick[0])]) {
      for (const Share& j : shares[1][static_cast<std::size_t>(brick[1])]) {
        for (const Share& k : shares[2][static_cast<std::size_t>(brick[2])]) {
          const double fraction = i.fraction * j.fraction * k.fraction;
          const double needed = fraction * (kCells + kActiveCells * kActiveCost);
          double done = fraction * (kCells * i.samples * j.samples * k.samples +
                                    kActiveCells * kActiveCost * i.vertices * j.vertices * k.vertices);
          std::uint8_t& pillar =
              begun[static_cast<std::size_t>((i.part * parts[1] + j.part) * parts[2] + k.part)];
          if (pillar == 0) done += kPillarCost;
          pillar = 1;
          load[static_cast<std::size_t>(pillars.rank_of({i.part, j.part, k.part}))] += done;
          forecast.redundant += done - needed;
          forecast.mean += done;
        }
      }
    }
  }
  forecast.mean /= static_cast<double>(load.size());
  forecast.slowest = *std::max_element(load.begin(), load.end());
  return forecast;
}

}  // namespace

WorkForecast forecast(const Pillars& pillars, const Bricks& bricks, float isovalue, bool normals) {
  return forecast_of(pillars, bricks.dims, active_bricks(bricks, isovalue), normals);
}

Interleaving choose_interleaving(const survey::Index& volume, int ranks, const Bricks& bricks, float isovalue,
                                 bool normals) {
  Interleaving best{1, 1, 1};
  const bool has_cells = volume[0] > 1 && volume[1] > 1 && volume[2] > 1;
  if (ranks == 1 || !has_cells) return best;
  const auto pillars_in = [](const Interleaving& one) { return one[0] * one[1] * one[2]; };
  std::vector<survey::Index> active = active_bricks(bricks, isovalue);
  const std::size_t every = active.size() / kMostBricks + 1;
  for (std::size_t n = 0; n * every < active.size(); ++n) active[n] = active[n * every];
  active.resize((active.size() + every - 1) / every);
  std::vector<std::pair<double, Interleaving>> ways;
  for (const int layers : {1, 2, 4}) {
    for (int a = 1; a <= kMostInterleaving; ++a) {
      for (int b = 1; b <= kMostInterleaving; ++b) {
        const Interleaving one{a, b, layers};
        ways.emplace_back(forecast_of(Pillars(volume, ranks, one), bricks.dims, active, normals).slowest,
                          one);
      }
    }
  }
  const double least = std::min_element(ways.begin(), ways.end())->first;
  best = {kMostInterleaving, kMostInterleaving, 4};
  for (const auto& [slowest, one] : ways) {
    if (slowest <= least * kAboutEqual && pillars_in(one) < pillars_in(best)) best = one;
  }
  return best;
}

}  // namespace footwall::isosurface
