// Faces and their statistics as CSV (RFC 4180):
// fault,face,x0,y0,z0,...,z2,count,nulls,outside,mean,variance,min,max, then a column for each further
// statistic in the order of first appearance. Numbers are the shortest that read back the same; an undefined
// one is empty.
#pragma once
#include <filesystem>
#include <optional>
#include <ostream>
#include <span>
#include <string>

#include "storage/formats/mesh_table.h"

namespace footwall::formats::faces_csv {

// What the coordinates are, told in four further columns at the end: xy_unit, z_unit, z_positive (up or
// down), crs.
struct Declared {
  std::string horizontal_unit = "m";
  std::string vertical_unit = "m";
  bool z_positive_up = false;  // z of the tables is turned
  std::string crs;
};

// Coordinates are printed as they stand in the tables (world or index space, the caller's choice), but for a
// z that is to be turned. A statistic that a table lacks gives empty cells. Throws kIo (a full disk leaves no
// file).
void write(const std::filesystem::path& path, std::span<const MeshTable> meshes,
           const std::optional<Declared>& declared = {});
// The same to a stream, for stdout.
void print(std::ostream& out, std::span<const MeshTable> meshes);

}  // namespace footwall::formats::faces_csv
