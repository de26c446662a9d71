#include "engine/render/best_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/render/camera.h"

namespace footwall::render {
namespace {

constexpr int kWidth = 240;
constexpr int kHeight = 160;
// Of larger meshes every n-th triangle is looked at: as good a sample at this size of picture.
constexpr std::size_t kMostTriangles = 200'000;
constexpr double kSectionWeight = 0.5;

// Every n-th triangle with vertices of its own, so that those in between cost nothing.
Surface sampled(const Surface& whole, std::size_t stride) {
  Surface some;
  for (std::size_t t = 0; t < whole.triangles.size(); t += stride) {
    const auto first = static_cast<std::int32_t>(some.positions.size());
    for (const std::int32_t v : whole.triangles[t])
      some.positions.push_back(whole.positions[static_cast<std::size_t>(v)]);
    some.triangles.push_back({first, first + 1, first + 2});
  }
  return some;
}

// How many pixels are seen of each surface.
std::vector<std::size_t> seen_of(const std::vector<Surface>& surfaces, const Camera& camera) {
  VisibilityBuffer buffer(kWidth, kHeight);
  std::vector<PrimitiveId> ends;
  std::vector<ScreenVertex> vertices;
  PrimitiveId first = 0;
  for (const Surface& surface : surfaces) {
    vertices.resize(surface.positions.size());
    project(camera.view_projection, surface.positions, kWidth, kHeight, vertices);
    rasterize(camera.view_projection, surface.positions, vertices, surface.triangles, first, buffer);
    first += static_cast<PrimitiveId>(surface.triangles.size());
    ends.push_back(first);
  }
  std::vector<std::size_t> seen(surfaces.size());
  for (const Visible pixel : buffer.pixels()) {
    const PrimitiveId id = primitive_of(pixel);
    if (id == kNoPrimitive) continue;
    ++seen[static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), id) - ends.begin())];
  }
  return seen;
}

// Between the eye and the survey's middle, the scene's origin.
bool stands_in_front(const Surface& section, const Camera& camera) {
  Vec3 sum;
  for (const Vec3f& p : section.positions) sum = sum + Vec3(p);
  return dot(sum, camera.forward) < 0;
}

}  // namespace

double best_azimuth(const SceneFrame& frame, std::span<const Surface> faults,
                    std::span<const Surface> sections, double elevation_degrees, bool perspective) {
  std::size_t triangles = 0;
  for (const Surface& fault : faults) triangles += fault.triangles.size();
  std::vector<Surface> drawn;
  for (const Surface& fault : faults) drawn.push_back(sampled(fault, 1 + triangles / kMostTriangles));
  drawn.insert(drawn.end(), sections.begin(), sections.end());

  const std::array<Vec3, 8> corners = frame.corners();
  const Vec3 along = corners[1] - corners[0];  // from the first inline to the last
  const double axis = std::atan2(along.x, along.y) * 180 / std::numbers::pi;
  double best = 0;
  double most = -1;
  for (int quarter = 0; quarter < 4; ++quarter) {
    for (const double turn : {45.0, 30.0, 60.0}) {
      const double azimuth = std::fmod(axis + 90 * quarter + turn + 360, 360);
      const Camera camera = Camera::look(azimuth, elevation_degrees, 1, corners,
                                         static_cast<double>(kWidth) / kHeight, perspective);
      const std::vector<std::size_t> seen = seen_of(drawn, camera);
      double score = 0;
      for (std::size_t n = 0; n < seen.size(); ++n) {
        const bool fault = n < faults.size();
        if (!fault && stands_in_front(drawn[n], camera)) continue;
        score += (fault ? 1 : kSectionWeight) * std::log1p(static_cast<double>(seen[n]));
      }
      if (score <= most) continue;
      most = score;
      best = azimuth;
    }
  }
  return best;
}

}  // namespace footwall::render
