#include "storage/formats/faces_csv.h"

#include <fmt/format.h>
#include <algorithm>

#include "storage/base/text.h"
#include "storage/formats/detail/csv.h"
#include "storage/formats/detail/output_file.h"

namespace footwall::formats::faces_csv {
namespace {

using detail::csv_quoted;

// The contract's columns first, present or not, then the others as they appear.
std::vector<std::string> columns_of(std::span<const MeshTable> meshes) {
  std::vector<std::string> columns{"count", "nulls", "outside", "mean", "variance", "min", "max"};
  for (std::string& name : statistic_names(meshes)) {
    if (std::find(columns.begin(), columns.end(), name) == columns.end()) columns.push_back(std::move(name));
  }
  return columns;
}

template <class Put>
void print_rows(std::span<const MeshTable> meshes, const std::optional<Declared>& declared, const Put& put) {
  const bool up = declared && declared->z_positive_up;
  const std::string told = declared ? fmt::format(",{},{},{},{}", csv_quoted(declared->horizontal_unit),
                                                  csv_quoted(declared->vertical_unit), up ? "up" : "down",
                                                  csv_quoted(declared->crs))
                                    : "";
  const std::vector<std::string> columns = columns_of(meshes);
  std::string line = "fault,face,x0,y0,z0,x1,y1,z1,x2,y2,z2";
  for (const std::string& column : columns) line += ',' + csv_quoted(column);
  if (declared) line += ",xy_unit,z_unit,z_positive,crs";
  put(line += '\n');
  for (const MeshTable& mesh : meshes) {
    check(mesh);
    std::vector<const FaceStatistic*> values;
    for (const std::string& column : columns) {
      const auto found =
          std::find_if(mesh.statistics.begin(), mesh.statistics.end(),
                       [&](const FaceStatistic& statistic) { return statistic.name == column; });
      values.push_back(found == mesh.statistics.end() ? nullptr : &*found);
    }
    const std::string fault = csv_quoted(mesh.fault);
    for (std::size_t face = 0; face < mesh.triangles.size(); ++face) {
      line = fault + ',' + csv_quoted(mesh.face_ids[face]);
      for (const std::int32_t vertex : mesh.triangles[face]) {
        const survey::WorldPoint& p = mesh.vertices[static_cast<std::size_t>(vertex)];
        for (const double coordinate : {p.x, p.y, up ? 0.0 - p.z : p.z})
          line += ',' + text::shortest(coordinate);
      }
      for (const FaceStatistic* statistic : values) {
        line += ',';
        if (statistic != nullptr) line += text::shortest(statistic->values[face]);
      }
      put((line += told) += '\n');
    }
  }
}

}  // namespace

void write(const std::filesystem::path& path, std::span<const MeshTable> meshes,
           const std::optional<Declared>& declared) {
  detail::OutputFile out(path);
  print_rows(meshes, declared, [&](const std::string& line) { out.write(line); });
  out.commit();
}

void print(std::ostream& out, std::span<const MeshTable> meshes) {
  print_rows(meshes, {}, [&](const std::string& line) { out << line; });
}

}  // namespace footwall::formats::faces_csv
