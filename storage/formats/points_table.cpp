#include "storage/formats/points_table.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "storage/formats/detail/output_file.h"

namespace footwall::formats::points_table {
namespace {

std::string one_word(std::string text) {
  for (char& letter : text) {
    if (static_cast<unsigned char>(letter) <= 0x20) letter = '_';
  }
  return text;
}

const FaceStatistic* find(const MeshTable& mesh, const std::string& name) {
  for (const FaceStatistic& statistic : mesh.statistics) {
    if (statistic.name == name) return &statistic;
  }
  return nullptr;
}

survey::WorldPoint centroid(const MeshTable& mesh, const std::array<std::int32_t, 3>& triangle) {
  survey::WorldPoint sum;
  for (const std::int32_t corner : triangle) {
    const survey::WorldPoint& p = mesh.vertices[static_cast<std::size_t>(corner)];
    sum = {sum.x + p.x, sum.y + p.y, sum.z + p.z};
  }
  return {sum.x / 3, sum.y / 3, sum.z / 3};
}

}  // namespace

std::vector<std::string> write(const std::filesystem::path& path, std::span<const MeshTable> meshes,
                               bool z_positive_up) {
  const std::vector<std::string> names = statistic_names(meshes);
  std::vector<std::string> renamed;
  const auto held = [&](const std::string& name) {
    std::string word = one_word(name);
    if (word != name) renamed.push_back(name + " -> " + word);
    return word;
  };
  detail::OutputFile out(path);
  out.write("X Y Z fault face");
  for (const std::string& name : names) out.print(" {}", held(name));
  out.write("\n");
  for (const MeshTable& mesh : meshes) {
    check(mesh);
    const std::string fault = held(mesh.fault);
    std::vector<const FaceStatistic*> columns;
    columns.reserve(names.size());
    for (const std::string& name : names) columns.push_back(find(mesh, name));
    for (std::size_t face = 0; face < mesh.triangles.size(); ++face) {
      const survey::WorldPoint p = centroid(mesh, mesh.triangles[face]);
      out.print("{:.6f} {:.6f} {:.6f} {} {}", p.x, p.y, z_positive_up ? 0.0 - p.z : p.z, fault,
                one_word(mesh.face_ids[face]));
      for (const FaceStatistic* column : columns) {
        const bool known = column != nullptr && std::isfinite(column->values[face]);
        known ? out.print(" {}", column->values[face]) : out.print(" {}", kUndefined);
      }
      out.write("\n");
    }
  }
  out.commit();
  return renamed;
}

}  // namespace footwall::formats::points_table
