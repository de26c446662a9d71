// VTK XML PolyData out: points as doubles, statistics as cell data, appended raw, UInt64 headers,
// little-endian.
#pragma once
#include <filesystem>
#include <span>

#include "storage/formats/mesh_table.h"

namespace footwall::formats::vtp {

enum class ZAxis : std::uint8_t {
  kUp,   // z = -depth, so that ParaView and other viewers show the surface upright
  kDown  // z as the survey has it, positive down
};

struct Options {
  ZAxis z_axis = ZAxis::kUp;
  std::string horizontal_unit = "m";  // the units and crs go into the file's field data
  std::string vertical_unit = "m";    // "ms", "s", "m", "ft"; told, not converted
  std::string crs;
};

// Meshes are written as one piece; cell data: `fault` (index into the field data `fault_names`, in the given
// order) and one Float64 array a statistic, NaN where undefined; field data says z's sign and unit. With kUp
// the winding is turned with the axis, so that normals keep their side. Face ids follow as `face_ids` field
// data. Throws kIo (a full disk leaves no file).
void write(const std::filesystem::path& path, std::span<const MeshTable> meshes, const Options& options = {});

}  // namespace footwall::formats::vtp
