// A fault's triangles with the statistics of a run, as plain values: what the CSV, VTP and TSurf writers
// take.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "storage/survey/points.h"

namespace footwall::formats {

struct FaceStatistic {
  std::string name;            // "count", "mean", "variance", ...; unique in its table
  std::vector<double> values;  // one a triangle; NaN = undefined
};

struct MeshTable {
  std::string fault;
  std::vector<survey::WorldPoint> vertices;            // X, Y, z positive down in the survey's vertical unit
  std::vector<std::array<std::int32_t, 3>> triangles;  // into vertices, from 0
  std::vector<std::string> face_ids;                   // one a triangle
  std::vector<FaceStatistic> statistics;
};

// Throws Error kInternal where sizes disagree or a triangle names a vertex that is not there.
void check(const MeshTable& mesh);

// The statistics that any of the meshes has, each once, in the order in which they first stand.
std::vector<std::string> statistic_names(std::span<const MeshTable> meshes);

}  // namespace footwall::formats
