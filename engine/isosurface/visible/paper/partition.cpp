#include "engine/isosurface/visible/paper/partition.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

struct Tile {
  double lo[2];  // in half pixels
  double hi[2];
};

class Cut {
 public:
  Cut(std::span<const PlacedWork> cells, std::vector<int>& rank_of) : cells_(cells), rank_of_(rank_of) {}

  // Gives `cells`, numbers of cells in the tile, to `ranks` ranks from first_rank on.
  void share(std::span<std::size_t> cells, const Tile& tile, int first_rank, int ranks) {
    if (ranks == 1 || cells.empty()) {
      for (const std::size_t cell : cells) rank_of_[cell] = first_rank;
      return;
    }
    const int axis = tile.hi[0] - tile.lo[0] >= tile.hi[1] - tile.lo[1] ? 0 : 1;
    std::sort(cells.begin(), cells.end(), [&](std::size_t a, std::size_t b) {
      return std::tuple(centre(a, axis), centre(a, 1 - axis), a) <
             std::tuple(centre(b, axis), centre(b, 1 - axis), b);
    });
    std::int64_t all = 0;
    for (const std::size_t cell : cells) all += cells_[cell].work;
    const int lower = (ranks + 1) / 2;
    // The cut whose lower share is nearest to all * lower / ranks; in whole numbers.
    std::size_t best = 0;
    std::int64_t least = all * lower;
    std::int64_t below = 0;
    for (std::size_t n = 0; n < cells.size(); ++n) {
      below += cells_[cells[n]].work;
      const std::int64_t off = std::abs(below * ranks - all * lower);
      if (off >= least) continue;
      least = off;
      best = n + 1;
    }
    Tile left = tile;
    Tile right = tile;
    const std::int64_t before = centre(cells[best > 0 ? best - 1 : 0], axis);
    const std::int64_t after = centre(cells[std::min(best, cells.size() - 1)], axis);
    left.hi[axis] = right.lo[axis] = static_cast<double>(before + after) / 2;
    share(cells.first(best), left, first_rank, lower);
    share(cells.subspan(best), right, first_rank + lower, ranks - lower);
  }

 private:
  // In half pixels.
  std::int64_t centre(std::size_t cell, int axis) const {
    const render::PixelRect& box = cells_[cell].box;
    return axis == 0 ? std::int64_t{box.x0} + box.x1 : std::int64_t{box.y0} + box.y1;
  }

  std::span<const PlacedWork> cells_;
  std::vector<int>& rank_of_;
};

}  // namespace

std::vector<int> partition_picture(std::span<const PlacedWork> cells, int width, int height, int ranks) {
  require(ranks >= 1, "at least one rank");
  std::vector<int> rank_of(cells.size());
  std::vector<std::size_t> numbers(cells.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  Cut(cells, rank_of).share(numbers, {{0, 0}, {2.0 * width, 2.0 * height}}, 0, ranks);
  return rank_of;
}

std::vector<int> deal_tiles(std::span<const std::int64_t> work_of_tiles,
                            std::span<const std::int64_t> triangles_of_ranks) {
  require(work_of_tiles.size() == triangles_of_ranks.size(), "a tile for each rank");
  std::vector<std::size_t> tiles(work_of_tiles.size());
  std::iota(tiles.begin(), tiles.end(), std::size_t{0});
  std::vector<std::size_t> ranks = tiles;
  std::stable_sort(tiles.begin(), tiles.end(),
                   [&](std::size_t a, std::size_t b) { return work_of_tiles[a] > work_of_tiles[b]; });
  std::stable_sort(ranks.begin(), ranks.end(), [&](std::size_t a, std::size_t b) {
    return triangles_of_ranks[a] < triangles_of_ranks[b];
  });
  std::vector<int> rank_of(tiles.size());
  for (std::size_t n = 0; n < tiles.size(); ++n) rank_of[tiles[n]] = static_cast<int>(ranks[n]);
  return rank_of;
}

}  // namespace footwall::isosurface
