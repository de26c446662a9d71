#include "engine/session/drawn_pieces.h"

#include <fmt/format.h>

#include <limits>

#include "storage/base/error.h"

namespace footwall::session {
namespace {

static_assert(sizeof(isosurface::Point) == sizeof(render::Vec3f) &&
              sizeof(isosurface::Triangle) == sizeof(render::TriangleIndices));

// Three floats each, under two names: the renderer does not know isosurfaces.
std::span<const render::Vec3f> as_vectors(std::span<const isosurface::Point> points) {
  return {reinterpret_cast<const render::Vec3f*>(points.data()), points.size()};
}
std::span<const render::TriangleIndices> as_indices(std::span<const isosurface::Triangle> triangles) {
  return {reinterpret_cast<const render::TriangleIndices*>(triangles.data()), triangles.size()};
}

std::vector<render::IdRun> runs_of(const isosurface::Piece& piece, std::uint64_t first_id) {
  const std::vector<std::uint64_t>& first = piece.surface.row_first;
  require(piece.row_numbers.size() + 1 == first.size(), "a number for each row of a piece");
  std::vector<render::IdRun> runs;
  std::uint64_t next = 0;  // the number that would go on the last run
  for (std::size_t row = 0; row + 1 < first.size(); ++row) {
    const std::uint64_t count = first[row + 1] - first[row];
    if (count == 0) continue;
    const std::uint64_t id = first_id + piece.row_numbers[row];
    if (id + count > render::kNoPrimitive) {
      throw Error(ErrorCode::kUnsupported,
                  fmt::format("a picture of more than {} triangles cannot be made", render::kNoPrimitive),
                  "choose another isovalue, or draw fewer isosurfaces at once");
    }
    if (runs.empty() || id != next)
      runs.push_back({static_cast<std::size_t>(first[row]), static_cast<render::PrimitiveId>(id)});
    next = id + count;
  }
  return runs;
}

}  // namespace

void DrawnPieces::add(std::span<const isosurface::Piece> pieces, std::uint64_t first_id, render::Rgba colour,
                      const render::Placement& placement) {
  for (const isosurface::Piece& piece : pieces) {
    const isosurface::Surface& surface = piece.surface;
    if (surface.triangles.empty()) continue;
    if (surface.positions.size() > std::numeric_limits<std::int32_t>::max()) {
      throw Error(
          ErrorCode::kUnsupported,
          fmt::format("a piece of an isosurface with {} vertices cannot be drawn", surface.positions.size()),
          "give --ranks more");
    }
    runs_.push_back(runs_of(piece, first_id));
    surfaces_.push_back({colour, placement, as_vectors(surface.positions.all()),
                         as_vectors(surface.normals.all()), as_indices(surface.triangles.all()),
                         runs_.back()});
  }
}

void DrawnPieces::clear() {
  surfaces_.clear();
  runs_.clear();
}

}  // namespace footwall::session
