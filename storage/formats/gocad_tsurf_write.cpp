#include <fmt/format.h>
#include <algorithm>

#include <cmath>

#include "storage/base/error.h"
#include "storage/formats/detail/output_file.h"
#include "storage/formats/gocad_tsurf.h"

namespace footwall::formats::gocad_tsurf {
namespace {

constexpr int kNoData = -99999;

// Names stand on one line; a brace would end the header.
std::string header_name(std::string text) {
  for (char& letter : text) {
    if (static_cast<unsigned char>(letter) < 0x20) letter = ' ';
    if (letter == '{') letter = '(';
    if (letter == '}') letter = ')';
  }
  return text;
}

// Property names stand between blanks.
std::string one_word(std::string text) {
  for (char& letter : text) {
    if (static_cast<unsigned char>(letter) <= 0x20) letter = '_';
  }
  return text;
}

double area_of(const MeshTable& mesh, const std::array<std::int32_t, 3>& triangle) {
  const survey::WorldPoint& a = mesh.vertices[static_cast<std::size_t>(triangle[0])];
  const survey::WorldPoint& b = mesh.vertices[static_cast<std::size_t>(triangle[1])];
  const survey::WorldPoint& c = mesh.vertices[static_cast<std::size_t>(triangle[2])];
  const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
  const double vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  return std::hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx) / 2;
}

// NaN at vertices that no face with a value and an area touches.
std::vector<double> at_vertices(const MeshTable& mesh, const std::string& name) {
  const auto statistic = std::find_if(mesh.statistics.begin(), mesh.statistics.end(),
                                      [&](const FaceStatistic& candidate) { return candidate.name == name; });
  if (statistic == mesh.statistics.end()) {
    throw Error(ErrorCode::kInvalid, fmt::format("fault {} has no statistic '{}'", mesh.fault, name));
  }
  std::vector<double> sums(mesh.vertices.size(), 0.0);
  std::vector<double> areas(mesh.vertices.size(), 0.0);
  for (std::size_t face = 0; face < mesh.triangles.size(); ++face) {
    const double value = statistic->values[face];
    if (!std::isfinite(value)) continue;
    const double area = area_of(mesh, mesh.triangles[face]);
    for (const std::int32_t vertex : mesh.triangles[face]) {
      sums[static_cast<std::size_t>(vertex)] += area * value;
      areas[static_cast<std::size_t>(vertex)] += area;
    }
  }
  for (std::size_t vertex = 0; vertex < sums.size(); ++vertex) sums[vertex] /= areas[vertex];
  return sums;
}

void write_axes(detail::OutputFile& out, const WriteOptions& options) {
  out.print(
      "GOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nAXIS_NAME \"X\" \"Y\" \"Z\"\n"
      "AXIS_UNIT \"{0}\" \"{0}\" \"{1}\"\nZPOSITIVE {2}\nEND_ORIGINAL_COORDINATE_SYSTEM\n",
      options.horizontal_unit, options.vertical_unit, options.z_positive_up ? "Elevation" : "Depth");
}

void write_properties(detail::OutputFile& out, const std::vector<std::string>& names) {
  if (names.empty()) return;
  std::string list, nulls, sizes;
  for (const std::string& name : names) {
    list += ' ' + one_word(name);
    nulls += fmt::format(" {}", kNoData);
    sizes += " 1";
  }
  out.print("PROPERTIES{}\nNO_DATA_VALUES{}\nESIZES{}\n", list, nulls, sizes);
}

void write_object(detail::OutputFile& out, const MeshTable& mesh, const WriteOptions& options) {
  out.print("GOCAD TSurf 1\nHEADER {{\nname:{}\n}}\n", header_name(mesh.fault));
  write_axes(out, options);
  if (!options.strict) out.write("GEOLOGICAL_TYPE fault\n");
  write_properties(out, options.properties);
  out.write("TFACE\n");
  std::vector<std::vector<double>> properties;
  for (const std::string& name : options.properties) properties.push_back(at_vertices(mesh, name));
  for (std::size_t n = 0; n < mesh.vertices.size(); ++n) {
    const survey::WorldPoint& p = mesh.vertices[n];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      throw Error(ErrorCode::kInvalid,
                  fmt::format("vertex {} of fault {} has no position", n + 1, mesh.fault));
    }
    out.print("{} {} {:.6f} {:.6f} {:.6f}", properties.empty() ? "VRTX" : "PVRTX", n + 1, p.x, p.y,
              options.z_positive_up ? 0.0 - p.z : p.z);
    for (const auto& values : properties) {
      std::isfinite(values[n]) ? out.print(" {}", values[n]) : out.print(" {}", kNoData);
    }
    out.write(options.strict ? " CNXYZ\n" : "\n");
  }
  for (const auto& [a, b, c] : mesh.triangles) out.print("TRGL {} {} {}\n", a + 1, b + 1, c + 1);
  out.write("END\n");
}

}  // namespace

std::vector<std::string> write(const std::filesystem::path& path, std::span<const MeshTable> meshes,
                               const WriteOptions& options) {
  if (options.strict && !options.properties.empty()) {
    throw Error(ErrorCode::kInvalid, "the strict TSurf form has no properties", "leave one of the two out");
  }
  std::vector<std::string> renamed;
  const auto tell = [&](const std::string& wanted, const std::string& held) {
    if (wanted != held) renamed.push_back(wanted + " -> " + held);
  };
  detail::OutputFile out(path);
  for (const MeshTable& mesh : meshes) {
    check(mesh);
    write_object(out, mesh, options);
    tell(mesh.fault, header_name(mesh.fault));
  }
  out.commit();
  for (const std::string& property : options.properties) tell(property, one_word(property));
  return renamed;
}

}  // namespace footwall::formats::gocad_tsurf
