// Area, dip and direction of a face: a pure function of the survey's geometry and the triangle, with
// arithmetic that gives the same bits everywhere (no libm beyond sqrt).
#pragma once
#include <optional>

#include "engine/extract/face.h"
#include "storage/survey/geometry.h"

namespace footwall::extract {

// NaN = undefined: all but the areas for a degenerate face; what is metric in a time survey without velocity.
// Of a vertical face the azimuth is that of the side its normal points to after turning it so that it does
// not point down: the winding decides.
struct FaceGeometry {
  double area_voxels = 0;           // in index space, voxels squared
  double area = kUndefined;         // in square metres
  double dip = kUndefined;          // degrees from the horizontal, 0..90; metric
  double dip_azimuth = kUndefined;  // degrees clockwise from north (+Y) in which the face goes down, 0 <= a <
                                    // 360; needs no velocity; undefined for a horizontal face
  double normal_i = kUndefined;     // unit normal in index space; its sign follows the winding
  double normal_j = kUndefined;
  double normal_k = kUndefined;
  double metres_along_normal = kUndefined;  // of one voxel's length along that normal; metric
};

// velocity: metres per second, for a time survey only (half of it, as times are two-way). Throws kInvalid for
// one that is not positive and finite.
FaceGeometry face_geometry(const survey::Geometry& geometry, const survey::LatticeTriangle& triangle,
                           std::optional<double> velocity = std::nullopt);

}  // namespace footwall::extract
