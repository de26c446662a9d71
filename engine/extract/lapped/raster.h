// A face's columns as a picture of their means in 8x8 tiles, and lines of what the voxels of a column differ
// by.
//
// A column of L voxels is transformed along the dominant axis by the orthonormal cosine transform of L
// values; its first coefficient, divided by sqrt(L), is the mean. Means of columns beside each other are
// alike, however long the columns are. The further coefficients, few and scattered, are lines: pictures of
// them would be mostly holes (measured: twice as many coefficients as values).
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/extract/lapped/columns.h"
#include "engine/extract/lapped/transform.h"

namespace footwall::extract::lapped {

// Columns longer than this (a face seen end on: a line or a point) are coded as a line.
inline constexpr std::int32_t kLongestColumn = 4;
inline constexpr std::size_t kDetails = kLongestColumn - 1;
using Details = std::array<std::vector<float>, kDetails>;

class Raster {
 public:
  // Lays the means out, tiles where there are any. False where a column is too long for it.
  bool lay_out(const Columns& columns);

  std::span<const Tile> tiles() const { return tiles_; }  // by rows
  std::size_t means() const { return places_.size(); }    // columns that are no gaps
  // Of the columns laid out: how many have coefficient 1 + n beside their mean.
  std::size_t details(std::size_t n) const { return details_[n]; }

  // The means into picture[64 tile + 8 row + column], places without one filled smoothly, and the further
  // coefficients into details, in the order of the columns; and back. values stand in the order of the
  // columns' voxels.
  void spread(const Columns& columns, std::span<const float> values, std::vector<float>& picture,
              Details& details) const;
  void collect(const Columns& columns, std::span<const float> picture, const Details& details,
               std::span<float> values) const;

 private:
  std::vector<Tile> tiles_;
  std::vector<std::uint8_t> known_;    // [tile][row]: bit c is set where column c of the row has a mean
  std::vector<std::uint32_t> places_;  // of every mean
  std::array<std::size_t, kDetails> details_{};
  std::vector<std::uint32_t> above_;  // the tile at each place of the former row of tiles, while laying out
  std::vector<std::uint32_t> here_;
};

}  // namespace footwall::extract::lapped
