// Based on: the VTK XML file formats, as VTK's wiki and its own writer state them.
#include "storage/formats/vtp_surface.h"

#include <fmt/format.h>

#include <bit>
#include <limits>

#include "storage/formats/detail/in_parts.h"
#include "storage/formats/detail/output_file.h"
#include "storage/formats/detail/xml.h"

namespace footwall::formats::vtp {
namespace {

static_assert(std::endian::native == std::endian::little, "the file's header says little-endian");

class Header {
 public:
  // Announces an array whose bytes follow in the order of their announcement.
  void announce(std::string_view type, std::string_view name, std::string_view attributes,
                std::uint64_t bytes) {
    text += fmt::format("<DataArray type=\"{}\" Name=\"{}\" {}format=\"appended\" offset=\"{}\"/>\n", type,
                        name, attributes, offset_);
    offset_ += sizeof(std::uint64_t) + bytes;
  }
  std::string text;

 private:
  std::uint64_t offset_ = 0;
};

// Connectivity and offsets of triangles.
template <class Number>
void put_polygons(detail::OutputFile& out, const TriangleSource& source, const JobContext& job) {
  detail::Records records;
  records.put(source.triangles * 3 * sizeof(Number));
  out.write(records.bytes());
  detail::write_triangles(out, source, job, [](detail::Records& to, const auto& corners) {
    for (const std::uint32_t vertex : corners) to.put(static_cast<Number>(vertex));
  });
  records.clear();
  records.put(source.triangles * sizeof(Number));
  out.write(records.bytes());
  detail::in_parts<Number>(
      source.triangles,
      [](std::uint64_t first, std::span<Number> part) {
        for (std::size_t n = 0; n < part.size(); ++n) part[n] = static_cast<Number>(3 * (first + n + 1));
      },
      [&](std::span<const Number> part) { out.write(std::as_bytes(part)); });
}

}  // namespace

void write_surface(const std::filesystem::path& path, const TriangleSource& source, const SurfaceFacts& facts,
                   const JobContext& job) {
  const std::uint64_t points = source.vertices, faces = source.triangles;
  const bool narrow = 3 * faces <= std::numeric_limits<std::int32_t>::max() &&
                      points <= std::numeric_limits<std::int32_t>::max();
  const std::string_view number_type = narrow ? "Int32" : "Int64";
  const std::uint64_t number = narrow ? sizeof(std::int32_t) : sizeof(std::int64_t);
  const std::array<std::pair<std::string_view, std::string>, 5> texts{
      {{"name", facts.name},
       {"horizontal_unit", facts.horizontal_unit},
       {"vertical_unit", facts.vertical_unit},
       {"z_positive", facts.z_positive},
       {"crs", facts.crs}}};
  Header header;
  header.text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n";
  for (const auto& [name, text] : texts) {
    header.announce("String", name, "NumberOfTuples=\"1\" ",
                    std::char_traits<char>::length(text.c_str()) + 1);
  }
  header.text += fmt::format(
      "</FieldData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
      "NumberOfStrips=\"0\" "
      "NumberOfPolys=\"{}\">\n",
      points, faces);
  if (source.has_normals) {
    header.text += "<PointData Normals=\"Normals\">\n";
    header.announce("Float32", "Normals", "NumberOfComponents=\"3\" ", points * 3 * sizeof(float));
    header.text += "</PointData>\n";
  }
  header.text += "<Points>\n";
  header.announce("Float64", "Points", "NumberOfComponents=\"3\" ", points * 3 * sizeof(double));
  header.text += "</Points>\n<Polys>\n";
  header.announce(number_type, "connectivity", "", faces * 3 * number);
  header.announce(number_type, "offsets", "", faces * number);
  header.text += "</Polys>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";

  detail::OutputFile out(path);
  out.write(header.text);
  const auto put_size = [&](std::uint64_t bytes) { out.write(std::as_bytes(std::span(&bytes, 1))); };
  for (const auto& [name, text] : texts) {
    const std::string_view whole(text.c_str(), std::char_traits<char>::length(text.c_str()) + 1);
    put_size(whole.size());
    out.write(whole);
  }
  const auto put_all = [&]<class Value>(std::uint64_t count, const auto& fill, Value) {
    put_size(count * sizeof(Value));
    detail::in_parts<Value>(count, fill, [&](std::span<const Value> part) {
      job.check();
      out.write(std::as_bytes(part));
    });
  };
  if (source.has_normals) put_all(points, source.normals, std::array<float, 3>{});
  put_all(points, source.positions, std::array<double, 3>{});
  narrow ? put_polygons<std::int32_t>(out, source, job) : put_polygons<std::int64_t>(out, source, job);
  out.write("\n</AppendedData>\n</VTKFile>\n");
  out.commit();
}

}  // namespace footwall::formats::vtp
