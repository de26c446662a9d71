// GOCAD TSurf (.ts) out and in: triangulated surfaces with properties at the vertices.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "storage/formats/mesh_table.h"
#include "storage/survey/surface.h"

namespace footwall::formats::gocad_tsurf {

struct WriteOptions {
  std::string horizontal_unit = "m";  // "m" or "ft"
  std::string vertical_unit = "m";    // "ms", "m" or "ft"
  bool z_positive_up = false;  // false: ZPOSITIVE Depth and z as the survey has it; true: Elevation and -z
  // Statistics to write as vertex properties: the mean over the faces around a vertex, weighted by their area
  // (in the units of the coordinates); a face without a value does not count, a vertex without any gets
  // -99999.
  std::vector<std::string> properties;
  // The narrow form that RMS and its peers read: a header of the name alone, VRTX ... CNXYZ, no properties.
  bool strict = false;
};

// One TSurf object a mesh, ids from 1, coordinates with six decimals. Throws kInvalid for a property that a
// mesh does not have or that is asked for together with `strict`, kIo (a full disk leaves no file).
void write(const std::filesystem::path& path, std::span<const MeshTable> meshes,
           const WriteOptions& options = {});

struct ReadReport {
  std::vector<std::string> assumed;   // e.g. "z is elevation: no ZPOSITIVE in F1"
  std::vector<std::string> warnings;  // triangles left out, with line and reason
};
struct ReadResult {
  std::vector<survey::Surface>
      surfaces;  // z positive down, one a TSurf object; PLine and VSet objects are skipped
  ReadReport report;
};
// Takes the oddities of real files: any ids, ATOM by id (a vertex of its own at
// the same position), several TFACE and objects, CR LF, PVRTX, missing
// END. Throws kNotFound, kIo, kFormat where there is no TSurf, kMemory above 2 GiB.
ReadResult read(const std::filesystem::path& path);
ReadResult parse(std::string_view text);

}  // namespace footwall::formats::gocad_tsurf
