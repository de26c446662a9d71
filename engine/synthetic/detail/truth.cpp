#include "engine/synthetic/detail/truth.h"

#include <algorithm>
#include <cmath>

#include "engine/synthetic/detail/random.h"

namespace footwall::synthetic::detail {
namespace {

using survey::IndexPoint;

constexpr std::uint64_t kJitterPurpose = 4;
constexpr std::int64_t kLeg = 8;          // voxels
constexpr std::int64_t kMostCells = 256;  // on an axis
constexpr std::int64_t kMostPillars = 1024;
constexpr double kLeastThrow = 1;  // samples; a tip line ends the twisted fault where it falls below

// The twisted fault's two blocks.
enum class Block : std::uint8_t { kFootwall, kHanging };

// > 0 in the twisted fault's hanging wall.
double above_twisted(const Structure& structure, const IndexPoint& p) {
  return p.i - structure.twisted_inline(p.j, p.k);
}

// The planar or listric fault at (i, k) in a block of the twisted one. Its hanging part came down by a throw
// that depends on the crossline sought; it changes it by far less than it moves, so that the iteration closes
// in.
IndexPoint on_older(const Structure& structure, FaultKind kind, double i, double k, Block block) {
  const auto crossline = [&](double depth) {
    return kind == FaultKind::kPlanar ? structure.planar_crossline(i, depth)
                                      : structure.listric_crossline(i, depth);
  };
  double j = crossline(k);
  if (block == Block::kFootwall) return {i, j, k};
  constexpr int kRounds = 40;
  for (int round = 0; round < kRounds; ++round) {
    const double before = j;
    j = crossline(k - structure.twisted_throw(i, j));
    if (j == before) break;
  }
  return {i, j, k};
}

struct Steps {
  double last;
  int cells;
  Steps(std::int64_t count, std::int64_t leg, std::int64_t most)
      : last(static_cast<double>(count - 1)),
        cells(static_cast<int>(std::clamp<std::int64_t>((count - 1 + leg / 2) / leg, 1, most))) {}
  double at(int n) const { return last * n / cells; }
};

Sheet inside(const Sheet& sheet, const survey::Index& size) {
  const double last_i = static_cast<double>(size[0] - 1);
  const double last_j = static_cast<double>(size[1] - 1);
  Sheet cut = clipped(sheet, [](const IndexPoint& p) { return p.i; });
  cut = clipped(cut, [&](const IndexPoint& p) { return last_i - p.i; });
  cut = clipped(cut, [](const IndexPoint& p) { return p.j; });
  return clipped(cut, [&](const IndexPoint& p) { return last_j - p.j; });
}

Sheet older_sheet(const Structure& structure, const survey::Index& size, FaultKind kind) {
  const Steps lines(size[0], kLeg, kMostCells);
  const Steps depths(size[2], kLeg, kMostCells);
  Sheet whole;
  for (const Block block : {Block::kFootwall, Block::kHanging}) {
    const double side = block == Block::kHanging ? 1 : -1;
    const Sheet sheet = inside(
        grid_sheet(lines.cells, depths.cells,
                   [&](int a, int b) { return on_older(structure, kind, lines.at(a), depths.at(b), block); }),
        size);
    whole = joined(whole,
                   clipped(sheet, [&](const IndexPoint& p) { return side * above_twisted(structure, p); }));
  }
  return whole;
}

Sheet twisted_sheet(const Structure& structure, const survey::Index& size) {
  const Steps crosslines(size[1], kLeg, kMostCells);
  const Steps depths(size[2], kLeg, kMostCells);
  const Sheet sheet = inside(grid_sheet(crosslines.cells, depths.cells,
                                        [&](int a, int b) {
                                          const double j = crosslines.at(a);
                                          const double k = depths.at(b);
                                          return IndexPoint{structure.twisted_inline(j, k), j, k};
                                        }),
                             size);
  return clipped(sheet, [&](const IndexPoint& p) { return structure.twisted_throw(p.i, p.j) - kLeastThrow; });
}

// Where a pillar of the section at `line` meets depth k; false where the fault is not there.
bool truth_on_section(const Structure& structure, FaultKind kind, double line, double k, IndexPoint& p) {
  if (kind == FaultKind::kTwisted) {
    p = {structure.twisted_inline(line, k), line, k};
    return structure.twisted_throw(p.i, p.j) >= kLeastThrow;
  }
  p = on_older(structure, kind, line, k, Block::kFootwall);
  if (above_twisted(structure, p) <= 0) return true;
  p = on_older(structure, kind, line, k, Block::kHanging);
  return above_twisted(structure, p) > 0;
}

}  // namespace

std::string_view name_of(FaultKind kind) {
  switch (kind) {
    case FaultKind::kPlanar:
      return "planar";
    case FaultKind::kListric:
      return "listric";
    case FaultKind::kTwisted:
      break;
  }
  return "twisted";
}

Sheet true_sheet(const Structure& structure, const survey::Index& size, FaultKind kind) {
  if (!structure.faulted()) return {};
  return kind == FaultKind::kTwisted ? twisted_sheet(structure, size) : older_sheet(structure, size, kind);
}

std::int64_t effective_spacing(const survey::Index& size, FaultKind kind, std::int64_t every_lines) {
  const std::int64_t lines = kind == FaultKind::kTwisted ? size[1] : size[0];
  const std::int64_t widest = std::max<std::int64_t>((lines - 1) / (kind == FaultKind::kTwisted ? 6 : 3), 1);
  return std::max(std::min(every_lines, widest), (lines + kMostPillars - 1) / kMostPillars);
}

std::vector<PickedPillar> picked_pillars(const Structure& structure, const survey::Index& size,
                                         FaultKind kind, const Picking& picking) {
  std::vector<PickedPillar> pillars;
  if (!structure.faulted()) return pillars;
  constexpr std::int64_t kNodeSamples = 24;
  constexpr std::int64_t kMostNodes = 512;
  const bool on_crosslines = kind == FaultKind::kTwisted;
  const std::int64_t lines = on_crosslines ? size[1] : size[0];
  const double last = static_cast<double>((on_crosslines ? size[0] : size[1]) - 1);
  const std::int64_t every = effective_spacing(size, kind, picking.every_lines);
  Steps depths(size[2], kNodeSamples, kMostNodes);
  depths.cells = std::max(depths.cells, 2);

  Draws draws(picking.seed, kJitterPurpose + static_cast<std::uint64_t>(kind));
  for (std::int64_t line = 0; line < lines; line += every) {
    PickedPillar pillar;
    for (int n = 0; n <= depths.cells; ++n) {
      // Drawn for every node, there or not, so that a node's jitter depends on its place alone.
      const double off = draws.between(-picking.jitter_voxels, picking.jitter_voxels);
      IndexPoint p;
      if (!truth_on_section(structure, kind, static_cast<double>(line), depths.at(n), p)) continue;
      double& across = on_crosslines ? p.i : p.j;
      if (across < 0 || across > last) continue;
      across = std::clamp(across + off, 0.0, last);
      pillar.push_back(p);
    }
    if (pillar.size() >= 2) pillars.push_back(std::move(pillar));
  }
  return pillars;
}

}  // namespace footwall::synthetic::detail
