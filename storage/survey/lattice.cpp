#include "storage/survey/lattice.h"

#include <fmt/format.h>

#include <cmath>

#include "storage/base/error.h"

namespace footwall::survey {
namespace {

constexpr double kLargest = 2147483520.0;  // below 2^31, so that 2^23 voxels and more are refused

std::int32_t rounded(double index) {
  const double scaled = index * kLatticePerVoxel;
  if (!(std::abs(scaled) < kLargest)) {
    throw Error(ErrorCode::kInvalid,
                fmt::format("the position {} on an index axis is 2^23 voxels or more away", index),
                "check the coordinates' unit and the survey's map");
  }
  return static_cast<std::int32_t>(std::nearbyint(scaled));  // the default mode: ties to even
}

}  // namespace

Lattice::Lattice(Geometry geometry) : geometry_(std::move(geometry)) {}

LatticePoint Lattice::from_index(const IndexPoint& p) const {
  return {rounded(p.i), rounded(p.j), rounded(p.k)};
}

LatticePoint Lattice::from_world(const WorldPoint& p) const {
  return from_index(geometry_.index_of(p));
}

IndexPoint Lattice::index_of(const LatticePoint& p) {
  constexpr double kVoxel = 1.0 / kLatticePerVoxel;
  return {p.i * kVoxel, p.j * kVoxel, p.k * kVoxel};
}

WorldPoint Lattice::world_of(const LatticePoint& p) const {
  return geometry_.world_of(index_of(p));
}

}  // namespace footwall::survey
