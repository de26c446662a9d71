#include "storage/formats/mesh_table.h"

#include <algorithm>

#include "storage/base/error.h"

namespace footwall::formats {

void check(const MeshTable& mesh) {
  require(mesh.face_ids.size() == mesh.triangles.size(), "a mesh table has one face id a triangle");
  for (const FaceStatistic& statistic : mesh.statistics) {
    require(statistic.values.size() == mesh.triangles.size(), "a statistic has one value a triangle");
  }
  const auto vertices = static_cast<std::int64_t>(mesh.vertices.size());
  for (const auto& triangle : mesh.triangles) {
    for (const std::int32_t vertex : triangle)
      require(vertex >= 0 && vertex < vertices, "triangles name vertices");
  }
}

std::vector<std::string> statistic_names(std::span<const MeshTable> meshes) {
  std::vector<std::string> names;
  for (const MeshTable& mesh : meshes) {
    for (const FaceStatistic& statistic : mesh.statistics) {
      if (std::find(names.begin(), names.end(), statistic.name) == names.end())
        names.push_back(statistic.name);
    }
  }
  return names;
}

}  // namespace footwall::formats
