#include "engine/tasks/write_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "storage/base/error.h"
#include "storage/formats/gocad_tsurf.h"
#include "storage/formats/ply.h"
#include "storage/formats/stl.h"
#include "storage/formats/vtp_surface.h"

namespace footwall::tasks {

using survey::Vector3;

SurfaceFormat surface_format_of(const std::filesystem::path& path) {
  std::string suffix = path.extension().string();
  for (char& letter : suffix) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  if (suffix == ".vtp") return SurfaceFormat::kVtp;
  if (suffix == ".ply") return SurfaceFormat::kPly;
  if (suffix == ".stl") return SurfaceFormat::kStl;
  if (suffix == ".ts") return SurfaceFormat::kTsurf;
  throw Error(ErrorCode::kUsage, fmt::format("{} names no format for surfaces", path.string()),
              "give a file that ends in .vtp, .ply, .stl or .ts");
}

SurfaceCoordinates surface_coordinates_from(std::string_view name) {
  if (name == "world") return SurfaceCoordinates::kWorld;
  if (name == "index") return SurfaceCoordinates::kIndex;
  throw Error(ErrorCode::kUsage, fmt::format("'{}' are no coordinates", name), "give world or index");
}

SurfaceFrame::SurfaceFrame(const survey::Geometry& geometry, SurfaceCoordinates coordinates,
                           SurfaceFormat format)
    : geometry_(geometry),
      index_(coordinates == SurfaceCoordinates::kIndex),
      z_sign_(index_ || format == SurfaceFormat::kTsurf ? 1 : -1) {
  std::array<Vector3, 3> steps{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  if (!index_) {
    const survey::MapView& map = geometry.map;
    steps = {{{map.per_inline_x, map.per_inline_y, 0},
              {map.per_crossline_x, map.per_crossline_y, 0},
              {0, 0, z_sign_ * geometry.interval}}};
  }
  const double determinant = dot(steps[0], cross(steps[1], steps[2]));
  if (!std::isfinite(determinant) || determinant == 0) {
    throw Error(ErrorCode::kInvalid, "the survey's map is singular: lines lie on top of each other");
  }
  mirrors_ = determinant < 0;
  for (std::size_t n = 0; n < 3; ++n) {
    normal_steps_[n] = cross(steps[(n + 1) % 3], steps[(n + 2) % 3]) * (1 / determinant);
  }
  facts_.horizontal_unit = index_ ? "voxel" : geometry.horizontal_unit;
  facts_.vertical_unit = index_ ? "voxel" : std::string(survey::name_of(geometry.vertical_unit));
  facts_.z_positive = z_sign_ > 0 ? "down" : "up";
  facts_.crs = index_ ? "" : geometry.crs;
}

std::array<double, 3> SurfaceFrame::position(const isosurface::Point& p) const {
  if (index_) return {p.i, p.j, p.k};
  const survey::WorldPoint world = geometry_.world_of(survey::IndexPoint{p.i, p.j, p.k});
  return {world.x, world.y, z_sign_ > 0 ? world.z : 0.0 - world.z};
}

std::array<float, 3> SurfaceFrame::normal(const isosurface::Point& n) const {
  if (index_) return {n.i, n.j, n.k};
  const Vector3 v = normal_steps_[0] * n.i + normal_steps_[1] * n.j + normal_steps_[2] * n.k;
  const double size = length(v);
  return {static_cast<float>(v.x / size), static_cast<float>(v.y / size), static_cast<float>(v.z / size)};
}

formats::TriangleSource source_of(const isosurface::Surface& surface, const SurfaceFrame& frame) {
  formats::TriangleSource source;
  source.vertices = surface.positions.size();
  source.triangles = surface.triangles.size();
  source.has_normals = !surface.normals.empty();
  source.positions = [&](std::uint64_t first, std::span<std::array<double, 3>> into) {
    for (std::size_t n = 0; n < into.size(); ++n) into[n] = frame.position(surface.positions[first + n]);
  };
  source.normals = [&](std::uint64_t first, std::span<std::array<float, 3>> into) {
    for (std::size_t n = 0; n < into.size(); ++n) into[n] = frame.normal(surface.normals[first + n]);
  };
  source.corners = [&](std::uint64_t first, std::span<std::array<std::uint32_t, 3>> into) {
    for (std::size_t n = 0; n < into.size(); ++n) {
      into[n] = surface.triangles[first + n];
      if (frame.mirrors()) std::swap(into[n][1], into[n][2]);
    }
  };
  return source;
}

void write_surface(const std::filesystem::path& path, const formats::TriangleSource& source,
                   const formats::SurfaceFacts& facts, const JobContext& job) {
  switch (surface_format_of(path)) {
    case SurfaceFormat::kVtp:
      return formats::vtp::write_surface(path, source, facts, job);
    case SurfaceFormat::kPly:
      return formats::ply::write(path, source, facts, job);
    case SurfaceFormat::kStl:
      return formats::stl::write(path, source, facts, job);
    case SurfaceFormat::kTsurf:
      return formats::gocad_tsurf::write_surface(path, source, facts, job);
  }
}

void write_surface(const std::filesystem::path& path, const isosurface::Surface& surface, std::string name,
                   const survey::Geometry& geometry, SurfaceCoordinates coordinates, const JobContext& job) {
  const SurfaceFrame frame(geometry, coordinates, surface_format_of(path));
  formats::SurfaceFacts facts = frame.facts();
  facts.name = std::move(name);
  write_surface(path, source_of(surface, frame), facts, job);
}

}  // namespace footwall::tasks
