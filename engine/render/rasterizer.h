// Triangles into a visibility buffer, exactly: vertices are projected once and rounded to 1/256 pixel,
// coverage is decided on integers with the top-left rule, so that over a shared edge each pixel centre is hit
// exactly once, on every machine alike. Pixel (x, y) has its centre at (x + 1/2, y + 1/2); both sides of a
// triangle are drawn. Based on: algorithms section 3.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/render/vector.h"
#include "engine/render/visibility.h"

namespace footwall::render {

inline constexpr int kSubPixelBits = 8;
inline constexpr std::int32_t kSubPixels = 1 << kSubPixelBits;
// Vertices farther than this from the picture's corner, in pixels, are cut off before rounding.
inline constexpr int kGuardBand = 1 << 17;

struct ScreenVertex {
  std::int32_t x = 0;         // in 1/256 pixel, to the right
  std::int32_t y = 0;         // in 1/256 pixel, downwards
  float depth = 0;            // window depth
  std::uint32_t outside = 0;  // bits of kOutside...: the triangle has to be clipped, or is skipped
};

inline constexpr std::uint32_t kOutsideNear = 1;
inline constexpr std::uint32_t kOutsideFar = 2;
inline constexpr std::uint32_t kOutsideLeft = 4;
inline constexpr std::uint32_t kOutsideRight = 8;
inline constexpr std::uint32_t kOutsideBottom = 16;
inline constexpr std::uint32_t kOutsideTop = 32;
inline constexpr std::uint32_t kNotFinite = 64;  // its triangles are skipped

using TriangleIndices = std::array<std::int32_t, 3>;

// The triangles from `first_triangle` to the next run's are the primitives first_id, first_id + 1, ...
struct IdRun {
  std::size_t first_triangle = 0;
  PrimitiveId first_id = 0;
  friend bool operator==(const IdRun&, const IdRun&) = default;
};

// Projects one position into a picture of width x height pixels.
ScreenVertex projected(const Vec4& clip, int width, int height);
// Projects all, the same bits as projected(); `to` has the positions' size.
void project(const Matrix4& view_projection, std::span<const Vec3f> positions, int width, int height,
             std::span<ScreenVertex> to);

// Draws triangle t as primitive first_id + t. `vertices` are the projected `positions` (which are looked at
// again only for triangles that have to be clipped). Indices must be inside (checked by check_indices, not
// here).
void rasterize(const Matrix4& view_projection, std::span<const Vec3f> positions,
               std::span<const ScreenVertex> vertices, std::span<const TriangleIndices> triangles,
               PrimitiveId first_id, VisibilityBuffer& into);
// The triangles [begin, end) alone, numbered by `runs`, which ascend by first_triangle and begin with 0.
struct TriangleRange {
  std::size_t begin = 0;
  std::size_t end = 0;
};
void rasterize(const Matrix4& view_projection, std::span<const Vec3f> positions,
               std::span<const ScreenVertex> vertices, std::span<const TriangleIndices> triangles,
               std::span<const IdRun> runs, const TriangleRange& range, VisibilityBuffer& into);
// One triangle given in clip space.
void rasterize_clip(const Vec4& a, const Vec4& b, const Vec4& c, PrimitiveId id, VisibilityBuffer& into);
// One triangle that is projected already and needs no clipping (outside == 0 for all three).
void rasterize_screen(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c, PrimitiveId id,
                      VisibilityBuffer& into);

// Throws Error kInvalid naming the first triangle that refers to a vertex that is not there.
void check_indices(std::span<const TriangleIndices> triangles, std::size_t vertex_count);

}  // namespace footwall::render
