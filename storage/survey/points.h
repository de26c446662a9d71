// The three kinds of position, kept apart by type.
#pragma once
#include <array>
#include <cstdint>

namespace footwall::survey {

// X, Y in the survey's CRS; z in the survey's vertical unit, positive down.
struct WorldPoint {
  double x = 0;
  double y = 0;
  double z = 0;
  friend bool operator==(const WorldPoint&, const WorldPoint&) = default;
};

// Index space: axes inline, crossline, sample; voxel (i,j,k) fills [i-1/2, i+1/2] and so on.
struct IndexPoint {
  double i = 0;
  double j = 0;
  double k = 0;
  friend bool operator==(const IndexPoint&, const IndexPoint&) = default;
};

// A position on the lattice: multiples of 1/256 voxel in index space. Made by Lattice alone.
inline constexpr std::int32_t kLatticePerVoxel = 256;
struct LatticePoint {
  std::int32_t i = 0;
  std::int32_t j = 0;
  std::int32_t k = 0;
  friend bool operator==(const LatticePoint&, const LatticePoint&) = default;
};
using LatticeTriangle = std::array<LatticePoint, 3>;

}  // namespace footwall::survey
