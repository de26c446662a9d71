// The frame of cameras and pictures: metres east, north, up from the survey's centre (design: "Scene frame").
// A time survey's milliseconds become metres by half the velocity; without one, 1 ms is drawn as 1 m.
#pragma once
#include <array>

#include "engine/render/vector.h"
#include "storage/survey/geometry.h"

namespace footwall::render {

class SceneFrame {
 public:
  // exaggeration multiplies heights, > 0. velocity in m/s, 0 = not known (used by time surveys alone).
  // Throws Error kUsage for other values, kInvalid for a geometry that cannot be used.
  SceneFrame(const survey::Geometry& geometry, double exaggeration, double velocity);

  Vec3 scene_of(const survey::WorldPoint& p) const;
  Vec3 scene_of(const survey::IndexPoint& p) const;
  // The eight corners of the voxels' box [-1/2, n-1/2]; bit 0 of the number: far inline end, bit 1:
  // crossline, bit 2: sample (deeper).
  std::array<Vec3, 8> corners() const;
  // The axis-parallel box around corners(): what zoom 1 fits.
  Bounds bounds() const;
  const survey::Geometry& geometry() const { return geometry_; }
  double exaggeration() const { return exaggeration_; }

  // A round exaggeration that makes the box about 0.6 as high as its longer side; 1 if it is high enough as
  // it is.
  static double pleasing_exaggeration(const survey::Geometry& geometry, double velocity);

 private:
  survey::Geometry geometry_;
  survey::WorldPoint centre_;
  double exaggeration_;
  double velocity_;
};

}  // namespace footwall::render
