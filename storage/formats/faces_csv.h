// Faces and their statistics as CSV (RFC 4180):
// fault,face,x0,y0,z0,...,z2,count,nulls,outside,mean,variance,min,max, then a column for each further
// statistic in the order of first appearance. Numbers are the shortest that read back the same; an undefined
// one is empty.
#pragma once
#include <filesystem>
#include <ostream>
#include <span>

#include "storage/formats/mesh_table.h"

namespace footwall::formats::faces_csv {

// Coordinates are printed as they stand in the tables (world or index space, the caller's choice).
// A statistic that a table lacks gives empty cells. Throws kIo (a full disk leaves no file).
void write(const std::filesystem::path& path, std::span<const MeshTable> meshes);
// The same to a stream, for stdout.
void print(std::ostream& out, std::span<const MeshTable> meshes);

}  // namespace footwall::formats::faces_csv
