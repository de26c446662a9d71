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
#include <vector>

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

// The same with arrays of its own.
struct OwnedSurface {
  Rgba colour = 0;
  Placement placement;
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;
  std::vector<TriangleIndices> triangles;
  std::vector<IdRun> runs;

  LitSurface view() const { return {colour, placement, positions, normals, triangles, runs}; }
};

// From normals in a surface's frame to right, up and towards the eye, row major; of any length.
std::array<float, 9> normals_to_view(const Placement& placement, const Camera& camera);

// Throws Error kInvalid where sizes do not fit, a triangle refers to a vertex that is not there, runs are out
// of order, or a placement is singular or not finite.
void check(const LitSurface& surface);

}  // namespace footwall::render
