// Vertices to fixed point, and the clipping of the few triangles that reach beyond what fixed point holds.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/render/clip.h"
#include "engine/render/rasterizer.h"
#include "storage/base/error.h"

namespace footwall::render {
namespace {

constexpr int kPlanes = 6;
constexpr int kMostCorners = ClippedFan::kMostCorners;
static_assert(kMostCorners == 3 + kPlanes);

// Signed distance to the n-th plane of the guarded view volume, scaled; inside is >= 0. The sides lie at the
// guard band, far outside of the picture, so that hardly any triangle meets them.
double inside_by(int plane, const Vec4& p, double guard_x, double guard_y) {
  switch (plane) {
    case 0:
      return p.w + p.z;
    case 1:
      return p.w - p.z;
    case 2:
      return guard_x * p.w + p.x;
    case 3:
      return guard_x * p.w - p.x;
    case 4:
      return guard_y * p.w + p.y;
    default:
      return guard_y * p.w - p.y;
  }
}

struct Polygon {
  std::array<Vec4, kMostCorners> corners;
  int count = 0;
};

Polygon clipped(const Polygon& polygon, int plane, double guard_x, double guard_y) {
  Polygon kept;
  for (int n = 0; n < polygon.count; ++n) {
    const Vec4& a = polygon.corners[static_cast<std::size_t>(n)];
    const Vec4& b = polygon.corners[static_cast<std::size_t>((n + 1) % polygon.count)];
    const double da = inside_by(plane, a, guard_x, guard_y);
    const double db = inside_by(plane, b, guard_x, guard_y);
    if (da >= 0) kept.corners[static_cast<std::size_t>(kept.count++)] = a;
    if ((da >= 0) == (db >= 0)) continue;
    // Always from the inner to the outer end: the neighbour across this edge cuts it at the same bits.
    const Vec4& in = da >= 0 ? a : b;
    const Vec4& out = da >= 0 ? b : a;
    const double share = std::max(da, db) / (std::max(da, db) - std::min(da, db));
    kept.corners[static_cast<std::size_t>(kept.count++)] = {
        in.x + (out.x - in.x) * share, in.y + (out.y - in.y) * share, in.z + (out.z - in.z) * share,
        in.w + (out.w - in.w) * share};
  }
  return kept;
}

ScreenVertex rounded(const Vec4& clip, double width, double height, std::uint32_t outside) {
  const double inverse = 1 / clip.w;
  ScreenVertex v;
  v.x = static_cast<std::int32_t>(std::lrint((clip.x * inverse * 0.5 + 0.5) * width * kSubPixels));
  v.y = static_cast<std::int32_t>(std::lrint((0.5 - clip.y * inverse * 0.5) * height * kSubPixels));
  v.depth = std::clamp(static_cast<float>(clip.z * inverse * 0.5 + 0.5), 0.0F, 1.0F);
  v.outside = outside;
  return v;
}

std::uint32_t outside_of(const Vec4& p, double guard_x, double guard_y) {
  if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z) || !std::isfinite(p.w))
    return kNotFinite;
  std::uint32_t bits = 0;
  for (int plane = 0; plane < kPlanes; ++plane) {
    if (inside_by(plane, p, guard_x, guard_y) < 0) bits |= 1U << static_cast<unsigned>(plane);
  }
  // Cannot be divided by, whatever the matrix was: left to the near plane.
  if (!(p.w > 0)) bits |= kOutsideNear;
  return bits;
}

}  // namespace

ScreenVertex projected(const Vec4& clip, int width, int height) {
  const std::uint32_t outside = outside_of(clip, 2.0 * kGuardBand / width, 2.0 * kGuardBand / height);
  if (outside != 0) return {0, 0, 0, outside};
  return rounded(clip, width, height, 0);
}

ClippedFan clipped_fan(const Vec4& a, const Vec4& b, const Vec4& c, int width, int height) {
  const double guard_x = 2.0 * kGuardBand / width;
  const double guard_y = 2.0 * kGuardBand / height;
  const std::uint32_t oa = outside_of(a, guard_x, guard_y);
  const std::uint32_t ob = outside_of(b, guard_x, guard_y);
  const std::uint32_t oc = outside_of(c, guard_x, guard_y);
  if (((oa | ob | oc) & kNotFinite) != 0 || (oa & ob & oc) != 0) return {};
  Polygon polygon;
  polygon.corners[0] = a;
  polygon.corners[1] = b;
  polygon.corners[2] = c;
  polygon.count = 3;
  for (int plane = 0; plane < kPlanes && polygon.count > 0; ++plane) {
    if (((oa | ob | oc) >> static_cast<unsigned>(plane) & 1U) != 0)
      polygon = clipped(polygon, plane, guard_x, guard_y);
  }
  ClippedFan fan;
  for (int n = 0; n < polygon.count; ++n) {
    const Vec4& p = polygon.corners[static_cast<std::size_t>(n)];
    if (!(p.w > 0)) return {};  // only through a matrix whose near plane does not keep the eye out
    fan.corners[static_cast<std::size_t>(n)] = rounded(p, width, height, 0);
  }
  fan.count = polygon.count;
  return fan;
}

void rasterize_clip(const Vec4& a, const Vec4& b, const Vec4& c, PrimitiveId id, VisibilityBuffer& into) {
  const ClippedFan fan = clipped_fan(a, b, c, into.width(), into.height());
  for (int n = 2; n < fan.count; ++n) {
    rasterize_screen(fan.corners[0], fan.corners[static_cast<std::size_t>(n - 1)],
                     fan.corners[static_cast<std::size_t>(n)], id, into);
  }
}

void check_indices(std::span<const TriangleIndices> triangles, std::size_t vertex_count) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const std::int32_t v : triangles[t]) {
      if (v >= 0 && static_cast<std::size_t>(v) < vertex_count) continue;
      throw Error(ErrorCode::kInvalid,
                  fmt::format("triangle {} refers to vertex {}; there are {}", t, v, vertex_count));
    }
  }
}

}  // namespace footwall::render
