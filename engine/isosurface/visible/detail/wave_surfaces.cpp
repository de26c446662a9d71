#include "engine/isosurface/visible/detail/wave_surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "storage/base/error.h"

namespace footwall::isosurface::detail {
namespace {

static_assert(sizeof(Point) == sizeof(render::Vec3f) && sizeof(Triangle) == sizeof(render::TriangleIndices));

// The same numbers under the renderer's names, which knows no isosurfaces.
std::span<const render::Vec3f> as_vectors(std::span<const Point> points) {
  return {reinterpret_cast<const render::Vec3f*>(points.data()), points.size()};
}
std::span<const render::TriangleIndices> as_indices(std::span<const Triangle> triangles) {
  return {reinterpret_cast<const render::TriangleIndices*>(triangles.data()), triangles.size()};
}

// Moves what is kept to the front, and numbers it.
void keep_met(const Screen& screen, std::span<const PartRun> part_runs, const BrickNumbers& numbers,
              WaveSurface& wave) {
  PageVector<Triangle>& triangles = wave.surface.triangles;
  std::size_t kept = 0;
  wave.runs.clear();
  for (std::size_t n = 0; n < part_runs.size(); ++n) {
    const std::size_t end = n + 1 < part_runs.size() ? part_runs[n + 1].first_triangle : triangles.size();
    const std::size_t first = kept;
    kept = keep_met(screen, triangles.all(), part_runs[n].first_triangle, end, kept);
    if (kept > first) wave.runs.push_back({first, numbers.first_of(part_runs[n])});
  }
  triangles.grow(kept);
}

survey::Box cells_of_bricks(const survey::Box& bricks, const Field& field) {
  survey::Box cells;
  for (int axis = 0; axis < 3; ++axis) {
    cells.lo[axis] = 8 * bricks.lo[axis];
    cells.hi[axis] = std::min(8 * bricks.hi[axis], field.volume_size[axis] - 1);
  }
  return cells;
}

}  // namespace

void WaveSurfaces::begin(const VisibleRequest& request) {
  used_ = 0;
  frame_.begin(request.camera, request.width, request.height);
}

std::int64_t WaveSurfaces::add(const Field& field, const survey::Box& bricks,
                               std::span<const BrickParts> chosen, const VisibleRequest& request,
                               const BrickNumbers& numbers, const EarlierWaves& earlier) {
  if (used_ == surfaces_.size()) surfaces_.emplace_back();
  WaveSurface& wave = surfaces_[used_];
  ExtractOptions options;
  options.threads = request.threads;
  options.cells = cells_of_bricks(bricks, field);
  options.bricks = &request.bricks;
  options.parts = chosen;
  options.part_runs = &part_runs_;
  extract(field, request.isovalue, options, wave.surface);
  Surface& surface = wave.surface;
  if (surface.triangles.empty()) return 0;
  if (surface.positions.size() > std::numeric_limits<std::int32_t>::max()) {
    throw Error(
        ErrorCode::kUnsupported,
        fmt::format("a piece of an isosurface with {} vertices cannot be drawn", surface.positions.size()),
        "take more ranks");
  }
  ++used_;
  const std::size_t place = frame_.add({request.colour,
                                        request.placement,
                                        as_vectors(surface.positions.all()),
                                        as_vectors(surface.normals.all()),
                                        {},
                                        {}},
                                       request.threads);
  keep_met(Screen{frame_.vertices_of(place), request.width, request.height, earlier}, part_runs_, numbers,
           wave);
  frame_.keep(place, as_indices(surface.triangles.all()), wave.runs);
  return static_cast<std::int64_t>(surface.triangles.size());
}

}  // namespace footwall::isosurface::detail
