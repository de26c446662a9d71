// GOCAD TSurf (.ts) out and in: triangulated surfaces with properties at the vertices.
#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "storage/base/job_context.h"
#include "storage/formats/import_report.h"
#include "storage/formats/mesh_table.h"
#include "storage/formats/triangle_source.h"
#include "storage/survey/surface.h"

namespace footwall::formats::gocad_tsurf {

struct WriteOptions {
  std::string horizontal_unit = "m";  // "m" or "ft"
  std::string vertical_unit = "m";    // "ms", "s", "m" or "ft"; told, not converted
  bool z_positive_up = false;  // false: ZPOSITIVE Depth and z as the survey has it; true: Elevation and -z
  // Statistics to write as vertex properties: the mean over the faces around a vertex, weighted by their area
  // (in the units of the coordinates); a face without a value does not count, a vertex without any gets
  // -99999.
  std::vector<std::string> properties;
  // The narrow form that RMS and its peers read: a header of the name alone, VRTX ... CNXYZ, no properties.
  bool strict = false;
};

// One TSurf object a mesh, ids from 1, coordinates with six decimals. Returns the names that the format
// cannot hold, as "old -> new". Throws kInvalid for a property that a mesh does not have or that is asked for
// together with `strict`, kIo (a full disk leaves no file).
std::vector<std::string> write(const std::filesystem::path& path, std::span<const MeshTable> meshes,
                               const WriteOptions& options = {});

// One large surface as one TSurf object, ids from 1, coordinates with six decimals; normals have no place.
// Throws kIo (a full disk leaves no file), kCancelled, what the source throws.
void write_surface(const std::filesystem::path& path, const TriangleSource& source, const SurfaceFacts& facts,
                   const JobContext& job = {});

// One TSurf object of a file.
struct Object {
  survey::Surface surface;  // numbers as the file has them, but for z: positive down once it is known
  // As ZPOSITIVE has it; nothing where it is not said: elevation was assumed.
  std::optional<bool> z_positive_up;
  // As AXIS_UNIT has them: "m", "ft", "ms", "s"; empty where none is said or none that is known.
  std::string horizontal_unit, vertical_unit;
  std::vector<std::string> properties;  // at the vertices; their values are not kept
};

struct ReadResult {
  std::vector<Object> objects;  // those with triangles, in the file's order
  // read: vertices, atoms and triangles; skipped: triangles' and vertices' rows aside, everything else;
  // rejected: rows that cannot be used, objects that are no TSurf or have no triangles.
  ImportReport report;
};

// Takes the oddities of real files: any ids, ATOM by id (a vertex of its own at the same position), several
// TFACE and objects, CR LF, trailing blanks, PVRTX, CNXYZ, no coordinate system, no END. A .ml model is read
// for the TSurf objects in it. z_positive_up overrides what the file says. Throws kNotFound, kIo, kFormat
// where there is no TSurf with triangles, kMemory above 2 GiB.
ReadResult read(const std::filesystem::path& path, std::optional<bool> z_positive_up = {});
ReadResult parse(std::string_view text, std::optional<bool> z_positive_up = {});

}  // namespace footwall::formats::gocad_tsurf
