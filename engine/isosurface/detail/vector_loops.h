// The loops of the variant `vector`: over contiguous arrays, without branches, compiled for every instruction
// set and chosen at run time. Arrays may be read and written up to 64 bytes behind `count`.
#pragma once
#include <array>
#include <cstdint>

namespace footwall::isosurface::detail {

// inside: 1 where the value is at or above the isovalue, nulls: 1 where it is null, else 0. Returns whether
// any is null.
bool to_booleans(const float* values, std::int64_t count, float isovalue, std::uint8_t* inside,
                 std::uint8_t* nulls);
// t[n]: where between lower[n] and upper[n] the isovalue lies, see crossing(); of edges that are not crossed
// anything between the limits.
void interpolate(const float* lower, const float* upper, std::int64_t count, float isovalue, float* t);
// Not zero where one end is inside, the other is outside, and none is null; `nulls` of the two may be null
// pointers where there are none.
void cross(const std::array<const std::uint8_t*, 2>& inside, const std::array<const std::uint8_t*, 2>& nulls,
           std::int64_t count, std::uint8_t* crossing);
// The signs of the cell at n from its four rows of samples (i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1).
void to_indices(const std::array<const std::uint8_t*, 4>& inside, std::int64_t count, std::uint8_t* signs);
// Not zero where one of the cell's samples is null.
void any_of_cell(const std::array<const std::uint8_t*, 4>& nulls, std::int64_t count, std::uint8_t* any);

}  // namespace footwall::isosurface::detail
