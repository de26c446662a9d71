#include "engine/extract/cache/brick_owners.h"

#include <algorithm>

namespace footwall::extract {

BrickOwners::BrickOwners(const comm::RankGrid& grid) : along_crosslines_(grid.parts()[1]) {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const std::int64_t lines = grid.dims()[axis];
    const int coordinates = grid.parts()[axis];
    const auto bricks = static_cast<std::size_t>((lines + kBrickSide - 1) / kBrickSide);
    bricks_[axis] = bricks;
    owned_[axis].resize(static_cast<std::size_t>(coordinates) * bricks);
    held_[axis].resize(owned_[axis].size());
    for (std::int64_t line = 0; line < lines; ++line) {
      const auto coordinate = static_cast<int>(line / grid.lines()[axis] % coordinates);
      const std::size_t row = row_of(axis, coordinate);
      owned_[axis][row + static_cast<std::size_t>(line >> 3)] |= static_cast<std::uint8_t>(1U << (line & 7));
      for (std::int64_t near = std::max<std::int64_t>(line - 1, 0); near <= std::min(line + 1, lines - 1);
           ++near) {
        held_[axis][row + static_cast<std::size_t>(near >> 3)] |= static_cast<std::uint8_t>(1U << (near & 7));
      }
    }
    for (std::size_t brick = 0; brick < bricks; ++brick) {
      first_[axis].push_back(parts_[axis].size());
      for (int coordinate = 0; coordinate < coordinates; ++coordinate) {
        const std::uint8_t mine = owned_[axis][row_of(axis, coordinate) + brick];
        if (mine != 0) parts_[axis].push_back({coordinate, mine});
      }
    }
    first_[axis].push_back(parts_[axis].size());
  }
}

MaskProduct BrickOwners::product(const std::array<std::vector<std::uint8_t>, 2>& lines, int rank,
                                 const std::array<std::int32_t, 3>& brick) const {
  const std::size_t i = row_of(0, rank / along_crosslines_) + static_cast<std::size_t>(brick[0]);
  const std::size_t j = row_of(1, rank % along_crosslines_) + static_cast<std::size_t>(brick[1]);
  return {lines[0][i], bytes(lines[1][j])};
}

}  // namespace footwall::extract
