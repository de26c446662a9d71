// Faces and statistics as plain arrays in one file, for programs that map it into memory. Everything is
// little-endian and begins at a multiple of 8 bytes:
//   vertices   float64 (vertices, 3)  X, Y, z positive down, as in the tables
//   triangles  int32   (faces, 3)     rows of `vertices`
//   fault      int32   (faces)        which of the tables
//   face       text    (faces)        the face's name, filled up with zero bytes
//   and each statistic, float64 (faces), NaN where undefined or not in a table.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "storage/formats/mesh_table.h"

namespace footwall::formats::face_arrays {

struct Array {
  std::string name;  // "vertices" ..., or "statistic:NAME"
  std::string type;  // "<f8", "<i4" or "|S12", as NumPy writes types
  std::vector<std::int64_t> shape;
  std::int64_t offset = 0;  // bytes from the file's begin
};

// Returns where each array stands, in the file's order. Throws kInvalid for more than 2^31 - 1 vertices, kIo
// (a full disk leaves no file).
std::vector<Array> write(const std::filesystem::path& path, std::span<const MeshTable> meshes);

}  // namespace footwall::formats::face_arrays
