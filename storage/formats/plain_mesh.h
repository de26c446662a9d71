// Triangle meshes without anything around them, from files that other programs write: PLY (text or binary,
// little endian) and binary STL.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace footwall::formats {

struct PlainMesh {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<float, 3>> normals;  // one per vertex, of length 1, or 0 where there is none
  std::vector<std::array<std::int32_t, 3>> triangles;
};

// PLY: vertices with float x, y, z and, if they have them, nx, ny, nz; faces of three corners. Other
// properties of a fixed size are passed over. STL: every triangle has its own three vertices. Normals that
// the file does not have are those of the triangles, at a vertex their sum weighed by area. Throws Error
// kNotFound, kFormat naming what is wrong, kUnsupported for what the format can hold and this cannot.
PlainMesh read_plain_mesh(const std::filesystem::path& path);

}  // namespace footwall::formats
