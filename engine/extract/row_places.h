// The places of a row's voxels in a block, many columns at once.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

namespace footwall::extract {

// Columns that list_places() takes at once, and places that it may write for them, with room for a vector
// more behind, which it touches.
inline constexpr std::size_t kPlaceColumns = 64;
inline constexpr std::size_t kPlacesOfColumn = 4;
inline constexpr std::size_t kPlaceRoom = kPlaceColumns * kPlacesOfColumn + 16;

struct Strides {
  std::int64_t u = 0;
  std::int32_t w = 0;
};

// Writes column + n strides.u + w strides.w for the columns n < lo.size() <= kPlaceColumns and the first
// kPlacesOfColumn w of lo[n]..hi[n]; in no particular order. Returns how many; `longest` is raised to the
// longest column's length: where it is more than kPlacesOfColumn, the caller sees to the rest.
std::size_t list_places(std::span<const std::int32_t> lo, std::span<const std::int32_t> hi,
                        std::int64_t column, const Strides& strides, std::int64_t* places,
                        std::int32_t& longest);

}  // namespace footwall::extract
