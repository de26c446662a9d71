#include "engine/render/coverage_mask.h"

#include <algorithm>
#include <bit>

#include "storage/base/error.h"

namespace footwall::render {
namespace {

constexpr int kShift = 3;  // of kTile
constexpr std::uint64_t kFull = ~std::uint64_t{0};
static_assert(CoverageMask::kTile == 1 << kShift);

// The bits of columns [x0, x1) in rows [y0, y1) of a tile.
constexpr std::uint64_t bits_of(int x0, int y0, int x1, int y1) {
  return CoverageMask::bits_in_tile({x0, y0, x1, y1});
}

constexpr int tiles_for(int size) {
  return (size + CoverageMask::kTile - 1) >> kShift;
}

}  // namespace

CoverageMask::CoverageMask(int width, int height) : width_(width), height_(height) {
  const VisibilityBuffer possible(width, height, 0, 1);  // throws where it is not
  int columns = width;
  int rows = height;
  do {
    columns = tiles_for(columns);
    rows = tiles_for(rows);
    levels_.push_back(
        {columns, rows,
         std::vector<std::uint64_t>(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows))});
  } while (columns > 1 || rows > 1);
  clear();
}

void CoverageMask::clear() {
  int columns = width_;
  int rows = height_;
  for (Level& level : levels_) {
    std::fill(level.words.begin(), level.words.end(), 0);
    // What lies beyond the borders is full, so that a word can be.
    if (const int rest = columns % kTile; rest != 0) {
      for (int row = 0; row < level.rows; ++row)
        level.words[static_cast<std::size_t>(row + 1) * static_cast<std::size_t>(level.columns) - 1] |=
            bits_of(rest, 0, kTile, kTile);
    }
    if (const int rest = rows % kTile; rest != 0) {
      for (auto word = level.words.end() - level.columns; word != level.words.end(); ++word)
        *word |= bits_of(0, rest, kTile, kTile);
    }
    columns = level.columns;
    rows = level.rows;
  }
}

bool CoverageMask::covers(const PixelRect& rect) const {
  const PixelRect inside{std::max(rect.x0, 0), std::max(rect.y0, 0), std::min(rect.x1, width_),
                         std::min(rect.y1, height_)};
  return inside.empty() || covers_within(levels_.size() - 1, 0, 0, inside);
}

bool CoverageMask::covers_within(std::size_t level, int column, int row, const PixelRect& pixels) const {
  const Level& here = levels_[level];
  const std::uint64_t word =
      here.words[static_cast<std::size_t>(row) * static_cast<std::size_t>(here.columns) +
                 static_cast<std::size_t>(column)];
  if (word == kFull) return true;
  const int shift = kShift * static_cast<int>(level);  // what a bit of this level stands for, in pixels
  const int x0 = std::max((pixels.x0 >> shift) - column * kTile, 0);
  const int y0 = std::max((pixels.y0 >> shift) - row * kTile, 0);
  const int x1 = std::min(((pixels.x1 - 1) >> shift) + 1 - column * kTile, kTile);
  const int y1 = std::min(((pixels.y1 - 1) >> shift) + 1 - row * kTile, kTile);
  std::uint64_t missing = bits_of(x0, y0, x1, y1) & ~word;
  if (level == 0) return missing == 0;
  for (; missing != 0; missing &= missing - 1) {
    const int bit = std::countr_zero(missing);
    if (!covers_within(level - 1, column * kTile + bit % kTile, row * kTile + bit / kTile, pixels))
      return false;
  }
  return true;
}

void CoverageMask::fill(const PixelRect& rect) {
  const PixelRect inside{std::max(rect.x0, 0), std::max(rect.y0, 0), std::min(rect.x1, width_),
                         std::min(rect.y1, height_)};
  if (inside.empty()) return;
  for (int row = inside.y0 / kTile; row * kTile < inside.y1; ++row) {
    const int y0 = std::max(inside.y0 - row * kTile, 0);
    const int y1 = std::min(inside.y1 - row * kTile, kTile);
    for (int column = inside.x0 / kTile; column * kTile < inside.x1; ++column) {
      add(column, row,
          bits_of(std::max(inside.x0 - column * kTile, 0), y0, std::min(inside.x1 - column * kTile, kTile),
                  y1));
    }
  }
}

std::int64_t CoverageMask::uncovered() const {
  std::int64_t pixels = 0;
  for (const std::uint64_t word : levels_.front().words) pixels += std::popcount(~word);
  return pixels;
}

std::span<const std::uint64_t> CoverageMask::tiles(int first, int last) const {
  require(0 <= first && first <= last && last <= tile_rows(), "rows of tiles of this picture");
  const auto columns = static_cast<std::size_t>(tile_columns());
  return std::span(levels_.front().words)
      .subspan(static_cast<std::size_t>(first) * columns, static_cast<std::size_t>(last - first) * columns);
}

void CoverageMask::merge(int first, std::span<const std::uint64_t> words) {
  const auto columns = static_cast<std::size_t>(tile_columns());
  require(
      first >= 0 && words.size() % columns == 0 &&
          static_cast<std::size_t>(first) + words.size() / columns <= static_cast<std::size_t>(tile_rows()),
      "whole rows of tiles of this picture");
  for (std::size_t n = 0; n < words.size(); ++n)
    add(static_cast<int>(n % columns), first + static_cast<int>(n / columns), words[n]);
}

void CoverageMask::tell_full(int column, int row) {
  for (std::size_t n = 1; n < levels_.size(); ++n) {
    Level& level = levels_[n];
    const auto bit = static_cast<unsigned>(row % kTile * kTile + column % kTile);
    column /= kTile;
    row /= kTile;
    std::uint64_t& word =
        level.words[static_cast<std::size_t>(row) * static_cast<std::size_t>(level.columns) +
                    static_cast<std::size_t>(column)];
    word |= std::uint64_t{1} << bit;
    if (word != kFull) return;
  }
}

}  // namespace footwall::render
