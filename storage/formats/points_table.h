// Points with attributes as text: a row of column names, then one row a face, columns parted by blanks:
// X Y Z fault face, then every statistic. What programs that load points with attributes read.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "storage/formats/mesh_table.h"

namespace footwall::formats::points_table {

inline constexpr int kUndefined = -99999;  // stands for NaN

// A point is the mean of its face's vertices, with six decimals; z is turned where z_positive_up. Statistics
// are the shortest numbers that read back the same. Blanks in names are written as '_': the names that had to
// be changed are returned as "old -> new". Throws kIo (a full disk leaves no file).
std::vector<std::string> write(const std::filesystem::path& path, std::span<const MeshTable> meshes,
                               bool z_positive_up);

}  // namespace footwall::formats::points_table
