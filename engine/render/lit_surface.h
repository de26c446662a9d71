// Surfaces of one colour with a normal at each vertex, lit at the vertices and interpolated between them
// (Gouraud): isosurfaces. They are drawn from where they were made: their own frame, usually index space, is
// taken to the scene by an affine map, and normals by its inverse transpose.
//
// Light is a headlight (along the view), a lamp at the upper left and an ambient term; a side is lit as it is
// seen, so that both sides show, the one that the normals do not point to a little darker. Nothing but sums,
// products, quotients and square roots, each rounded as IEEE 754 says: the same bits everywhere.
#pragma once
#include <array>
#include <span>

#include "engine/render/camera.h"
#include "engine/render/colour.h"
#include "engine/render/rasterizer.h"
#include "engine/render/vector.h"

namespace footwall::render {

// p -> linear * p + shift; linear is row major and not singular.
struct Placement {
  std::array<double, 9> linear{1, 0, 0, 0, 1, 0, 0, 0, 1};
  Vec3 shift;

  Vec3 operator()(const Vec3& p) const {
    return {linear[0] * p.x + linear[1] * p.y + linear[2] * p.z + shift.x,
            linear[3] * p.x + linear[4] * p.y + linear[5] * p.z + shift.y,
            linear[6] * p.x + linear[7] * p.y + linear[8] * p.z + shift.z};
  }
  // A frame of the other handedness: what was counter-clockwise comes out clockwise.
  bool mirrors() const;
  // Of view_projection and this: from the surface's frame to clip space.
  Matrix4 then(const Matrix4& view_projection) const;
  friend bool operator==(const Placement&, const Placement&) = default;
};

// A view of arrays that somebody else keeps.
struct LitSurface {
  Rgba colour = 0;
  Placement placement;
  std::span<const Vec3f> positions;
  std::span<const Vec3f> normals;  // one per position, of length 1 in the surface's frame
  // Counter-clockwise as seen from where the normals point, in a right-handed frame.
  std::span<const TriangleIndices> triangles;
  // The primitives' numbers; ascending by triangle and by number, the first run from triangle 0 on. No number
  // is used twice in a picture.
  std::span<const IdRun> runs;
};

// How a surface of one colour is lit as the camera sees it.
class Light {
 public:
  Light(const Placement& placement, const Camera& camera);
  // The share of a colour's brightness at a vertex with this normal; front: of the side that normals point
  // to.
  float at(const Vec3f& normal, bool front) const {
    const float x = to_view_[0] * normal.x + to_view_[1] * normal.y + to_view_[2] * normal.z;
    const float y = to_view_[3] * normal.x + to_view_[4] * normal.y + to_view_[5] * normal.z;
    const float z = to_view_[6] * normal.x + to_view_[7] * normal.y + to_view_[8] * normal.z;
    const float size = std::sqrt(x * x + y * y + z * z);
    const float inverse = size > 0 ? (front ? 1.0F : -1.0F) / size : 0.0F;
    const float facing = std::max(0.0F, z * inverse);
    const float lamp = std::max(0.0F, (x * kLamp[0] + y * kLamp[1] + z * kLamp[2]) * inverse);
    return (kAmbient + kHeadlight * facing + kLampShare * lamp) * (front ? 1.0F : kBackSide);
  }

 private:
  static constexpr float kAmbient = 0.26F;
  static constexpr float kHeadlight = 0.56F;
  static constexpr float kLampShare = 0.34F;
  static constexpr float kBackSide = 0.80F;
  // Towards the lamp, of length 1: left, up, towards the eye.
  static constexpr std::array<float, 3> kLamp{-0.60F, 0.64F, 0.48F};

  std::array<float, 9> to_view_{};  // normals to right, up, towards the eye; any length
};

// Throws Error kInvalid where sizes do not fit, a triangle refers to a vertex that is not there, runs are out
// of order, or a placement is singular or not finite.
void check(const LitSurface& surface);

}  // namespace footwall::render
