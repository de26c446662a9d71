// Which voxels of a brick a rank owns, and which it holds: those it owns and the halo of one trace around
// them. Ranks own whole columns in a grid, so both are products of some inlines and some crosslines.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/comm/rank_grid.h"
#include "engine/extract/cache/brick.h"

namespace footwall::extract {

// The voxels (i, j, k) of a brick with bit i set in `inlines` and all bits of byte j in `crosslines`.
struct MaskProduct {
  std::uint8_t inlines = 0;
  std::uint64_t crosslines = 0;

  bool empty() const { return inlines == 0 || crosslines == 0; }
  std::uint64_t word(std::size_t i) const { return (inlines >> i & 1) != 0 ? crosslines : 0; }
  bool all() const { return inlines == 0xFF && crosslines == ~std::uint64_t{0}; }
};
inline Mask operator&(const Mask& mask, const MaskProduct& product) {
  Mask both;
  for (std::size_t i = 0; i < both.size(); ++i) both[i] = mask[i] & product.word(i);
  return both;
}
inline Mask without(const Mask& mask, const MaskProduct& product) {
  Mask rest;
  for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = mask[i] & ~product.word(i);
  return rest;
}

class BrickOwners {
 public:
  explicit BrickOwners(const comm::RankGrid& grid);

  MaskProduct owned(int rank, const std::array<std::int32_t, 3>& brick) const {
    return product(owned_, rank, brick);
  }
  MaskProduct held(int rank, const std::array<std::int32_t, 3>& brick) const {
    return product(held_, rank, brick);
  }

  // visit(owner, MaskProduct) for every rank that owns voxels of the brick.
  template <typename Visit>
  void for_each_owner(const std::array<std::int32_t, 3>& brick, Visit&& visit) const {
    const auto i = static_cast<std::size_t>(brick[0]);
    const auto j = static_cast<std::size_t>(brick[1]);
    for (std::size_t a = first_[0][i]; a < first_[0][i + 1]; ++a) {
      for (std::size_t b = first_[1][j]; b < first_[1][j + 1]; ++b) {
        visit(parts_[0][a].coordinate * along_crosslines_ + parts_[1][b].coordinate,
              MaskProduct{parts_[0][a].lines, bytes(parts_[1][b].lines)});
      }
    }
  }

 private:
  // Bit j becomes all of byte j.
  static std::uint64_t bytes(std::uint8_t lines) {
    std::uint64_t all = 0;
    for (int j = 0; j < 8; ++j) all |= (lines >> j & 1) != 0 ? std::uint64_t{0xFF} << (8 * j) : 0;
    return all;
  }
  MaskProduct product(const std::array<std::vector<std::uint8_t>, 2>& lines, int rank,
                      const std::array<std::int32_t, 3>& brick) const;
  // The lines of one brick that belong to one rank coordinate.
  struct Part {
    int coordinate = 0;
    std::uint8_t lines = 0;
  };
  std::size_t row_of(std::size_t axis, int coordinate) const {
    return static_cast<std::size_t>(coordinate) * bricks_[axis];
  }

  int along_crosslines_ = 1;
  std::array<std::size_t, 2> bricks_{};             // along inlines and crosslines
  std::array<std::vector<std::size_t>, 2> first_;   // of each brick in parts_
  std::array<std::vector<Part>, 2> parts_;          // brick by brick
  std::array<std::vector<std::uint8_t>, 2> owned_;  // [coordinate][brick]
  std::array<std::vector<std::uint8_t>, 2> held_;   // [coordinate][brick]
};

}  // namespace footwall::extract
