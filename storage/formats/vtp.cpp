// Based on: the VTK XML file formats, as VTK's wiki and its own writer state them.
#include "storage/formats/vtp.h"

#include <fmt/format.h>
#include <algorithm>

#include <bit>
#include <cmath>
#include <limits>

#include "storage/base/error.h"
#include "storage/formats/detail/output_file.h"
#include "storage/formats/detail/xml.h"

namespace footwall::formats::vtp {
namespace {

static_assert(std::endian::native == std::endian::little, "the file's header says little-endian");

// The XML part and, one after the other, the arrays that it announces.
class Document {
 public:
  explicit Document(const std::filesystem::path& path) : out_(path) {}

  template <class... Values>
  void xml(fmt::format_string<Values...> pattern, Values&&... values) {
    out_.print(pattern, std::forward<Values>(values)...);
  }
  // Announces an array of `bytes` bytes; `attributes` are what only this one has.
  void announce(std::string_view type, const std::string& name, std::string_view attributes,
                std::uint64_t bytes) {
    xml("<DataArray type=\"{}\" Name=\"{}\" {}format=\"appended\" offset=\"{}\"/>\n", type,
        detail::xml_escaped(name), attributes, offset_);
    offset_ += sizeof(std::uint64_t) + bytes;
  }
  // The arrays' bytes follow in the order of their announcement.
  void begin_data() { xml("<AppendedData encoding=\"raw\">\n_"); }
  void begin_array(std::uint64_t bytes) { put(bytes); }
  template <class Value>
  void put(const Value& value) {
    out_.write(std::as_bytes(std::span(&value, 1)));
  }
  void put_string(const std::string& text) {
    out_.write(std::string_view(text.c_str(), text.size() + 1));  // with its end mark
  }
  void end() {
    xml("\n</AppendedData>\n</VTKFile>\n");
    out_.commit();
  }

 private:
  detail::OutputFile out_;
  std::uint64_t offset_ = 0;
};

std::uint64_t bytes_of(const std::vector<std::string>& strings) {
  std::uint64_t bytes = 0;
  for (const std::string& text : strings) bytes += text.size() + 1;
  return bytes;
}

// An end mark inside a name would shift all names after it.
std::string without_zeros(std::string text) {
  std::erase(text, '\0');
  return text;
}

void put_statistic(Document& file, std::span<const MeshTable> meshes, const std::string& name) {
  for (const MeshTable& mesh : meshes) {
    const auto found = std::find_if(mesh.statistics.begin(), mesh.statistics.end(),
                                    [&](const FaceStatistic& statistic) { return statistic.name == name; });
    for (std::size_t face = 0; face < mesh.triangles.size(); ++face) {
      file.put(found == mesh.statistics.end() ? std::numeric_limits<double>::quiet_NaN()
                                              : found->values[face]);
    }
  }
}

}  // namespace

void write(const std::filesystem::path& path, std::span<const MeshTable> meshes, const Options& options) {
  const bool up = options.z_axis == ZAxis::kUp;
  std::uint64_t points = 0, faces = 0;
  std::vector<std::string> faults, face_ids;
  for (const MeshTable& mesh : meshes) {
    check(mesh);
    points += mesh.vertices.size();
    faces += mesh.triangles.size();
    faults.push_back(without_zeros(mesh.fault));
    for (const std::string& id : mesh.face_ids) face_ids.push_back(without_zeros(id));
  }
  const std::vector<std::string> statistics = statistic_names(meshes);
  const std::vector<std::string> facts{options.horizontal_unit, options.vertical_unit, up ? "up" : "down",
                                       without_zeros(options.crs)};
  constexpr const char* kFactNames[] = {"horizontal_unit", "vertical_unit", "z_positive", "crs"};

  Document file(path);
  file.xml(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n");
  const auto strings = [&](const std::string& name, const std::vector<std::string>& values) {
    file.announce("String", name, fmt::format("NumberOfTuples=\"{}\" ", values.size()), bytes_of(values));
  };
  strings("fault_names", faults);
  for (std::size_t n = 0; n < facts.size(); ++n) strings(kFactNames[n], {facts[n]});
  file.xml(
      "</FieldData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
      "NumberOfStrips=\"0\" "
      "NumberOfPolys=\"{}\">\n<Points>\n",
      points, faces);
  file.announce("Float64", "Points", "NumberOfComponents=\"3\" ", points * 3 * sizeof(double));
  file.xml("</Points>\n<Polys>\n");
  file.announce("Int64", "connectivity", "", faces * 3 * sizeof(std::int64_t));
  file.announce("Int64", "offsets", "", faces * sizeof(std::int64_t));
  file.xml("</Polys>\n<CellData>\n");
  file.announce("Int32", "fault", "", faces * sizeof(std::int32_t));
  strings("face", face_ids);
  for (const std::string& name : statistics) file.announce("Float64", name, "", faces * sizeof(double));
  file.xml("</CellData>\n</Piece>\n</PolyData>\n");

  file.begin_data();
  const auto put_strings = [&](const std::vector<std::string>& values) {
    file.begin_array(bytes_of(values));
    for (const std::string& text : values) file.put_string(text);
  };
  put_strings(faults);
  for (const std::string& fact : facts) put_strings({fact});
  file.begin_array(points * 3 * sizeof(double));
  for (const MeshTable& mesh : meshes) {
    for (const survey::WorldPoint& p : mesh.vertices) file.put(std::array{p.x, p.y, up ? 0.0 - p.z : p.z});
  }
  file.begin_array(faces * 3 * sizeof(std::int64_t));
  std::int64_t first = 0;
  for (const MeshTable& mesh : meshes) {
    for (const auto& [a, b, c] : mesh.triangles) {
      // Mirroring z turns the winding's side; exchanging two corners turns it back.
      file.put(std::array<std::int64_t, 3>{first + a, first + (up ? c : b), first + (up ? b : c)});
    }
    first += static_cast<std::int64_t>(mesh.vertices.size());
  }
  file.begin_array(faces * sizeof(std::int64_t));
  for (std::uint64_t face = 1; face <= faces; ++face) file.put(static_cast<std::int64_t>(3 * face));
  file.begin_array(faces * sizeof(std::int32_t));
  for (std::size_t fault = 0; fault < meshes.size(); ++fault) {
    for (std::size_t face = 0; face < meshes[fault].triangles.size(); ++face)
      file.put(static_cast<std::int32_t>(fault));
  }
  put_strings(face_ids);
  for (const std::string& name : statistics) {
    file.begin_array(faces * sizeof(double));
    put_statistic(file, meshes, name);
  }
  file.end();
}

}  // namespace footwall::formats::vtp
