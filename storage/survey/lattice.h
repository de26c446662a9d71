// The only place where positions are rounded: world -> index space -> multiples of 1/256 voxel, ties to even.
#pragma once
#include "storage/survey/geometry.h"

namespace footwall::survey {

class Lattice {
 public:
  explicit Lattice(Geometry geometry);

  // Throws Error kInvalid for positions that are not finite or lie 2^23 voxels or more from the origin; the
  // caller adds the face's name.
  LatticePoint from_index(const IndexPoint& p) const;
  LatticePoint from_world(const WorldPoint& p) const;

  static IndexPoint index_of(const LatticePoint& p);
  WorldPoint world_of(const LatticePoint& p) const;
  const Geometry& geometry() const { return geometry_; }

 private:
  Geometry geometry_;
};

}  // namespace footwall::survey
