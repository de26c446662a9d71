// A surface into a file of the format that the file's suffix names.
#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "engine/isosurface/surface.h"
#include "storage/base/job_context.h"
#include "storage/formats/triangle_source.h"
#include "storage/survey/geometry.h"
#include "storage/survey/vector.h"

namespace footwall::tasks {

// .vtp, .ply, .stl, .ts in small or capital letters.
enum class SurfaceFormat : std::uint8_t { kVtp, kPly, kStl, kTsurf };
// Throws Error kUsage naming the suffixes there are.
SurfaceFormat surface_format_of(const std::filesystem::path& path);

enum class SurfaceCoordinates : std::uint8_t { kWorld, kIndex };
// "world" or "index"; throws Error kUsage for any other text.
SurfaceCoordinates surface_coordinates_from(std::string_view name);

// From index space to the coordinates of a file.
class SurfaceFrame {
 public:
  // kWorld: X and Y as the survey has them, z in the survey's vertical unit: up, the depth or time negated,
  // as viewers want it; but down, as the survey has it, in TSurf, whose header can say so. kIndex: inline,
  // crossline and sample index, z positive down. Throws Error kInvalid for a geometry whose map is singular.
  SurfaceFrame(const survey::Geometry& geometry, SurfaceCoordinates coordinates, SurfaceFormat format);

  std::array<double, 3> position(const isosurface::Point& p) const;
  // Stays at right angles to the surface, whatever the spacings; a unit vector in the file's coordinates.
  std::array<float, 3> normal(const isosurface::Point& n) const;
  // Whether the frame is left-handed seen from index space: then triangles are turned over, so that they run
  // counter-clockwise as seen from the side that the normals point to.
  bool mirrors() const { return mirrors_; }
  // Units, z's sign, crs; without a name.
  const formats::SurfaceFacts& facts() const { return facts_; }

 private:
  survey::Geometry geometry_;
  bool index_ = false;
  double z_sign_ = 1;
  std::array<survey::Vector3, 3> normal_steps_;  // the inverse of the map, transposed: columns
  bool mirrors_ = false;
  formats::SurfaceFacts facts_;
};

// The surface as the writers take it. It refers to both, which must live on.
formats::TriangleSource source_of(const isosurface::Surface& surface, const SurfaceFrame& frame);

// Any source in a format. Throws what the format's writer throws.
void write_surface(const std::filesystem::path& path, const formats::TriangleSource& source,
                   const formats::SurfaceFacts& facts, const JobContext& job = {});

// A whole surface in one call; the format is the suffix's. Throws Error kUsage for another suffix, and as
// above.
void write_surface(const std::filesystem::path& path, const isosurface::Surface& surface, std::string name,
                   const survey::Geometry& geometry, SurfaceCoordinates coordinates,
                   const JobContext& job = {});

}  // namespace footwall::tasks
