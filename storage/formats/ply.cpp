// Based on: Greg Turk, The PLY Polygon File Format, 1994; binary_little_endian 1.0 as its readers take it.
#include "storage/formats/ply.h"

#include <bit>

#include "storage/formats/detail/in_parts.h"
#include "storage/formats/detail/output_file.h"

namespace footwall::formats::ply {
namespace {

static_assert(std::endian::native == std::endian::little, "the file's header says little-endian");

// A comment is one line.
std::string one_line(std::string text) {
  for (char& letter : text) {
    if (static_cast<unsigned char>(letter) < 0x20) letter = ' ';
  }
  return text;
}

void write_header(detail::OutputFile& out, const TriangleSource& source, const SurfaceFacts& facts) {
  out.print("ply\nformat binary_little_endian 1.0\n");
  const auto comment = [&](const char* what, const std::string& text) {
    if (!text.empty()) out.print("comment {} {}\n", what, one_line(text));
  };
  comment("name", facts.name);
  comment("horizontal_unit", facts.horizontal_unit);
  comment("vertical_unit", facts.vertical_unit);
  comment("z_positive", facts.z_positive);
  comment("crs", facts.crs);
  out.print("element vertex {}\nproperty double x\nproperty double y\nproperty double z\n", source.vertices);
  if (source.has_normals) out.write("property float nx\nproperty float ny\nproperty float nz\n");
  out.print("element face {}\nproperty list uchar uint vertex_indices\nend_header\n", source.triangles);
}

}  // namespace

void write(const std::filesystem::path& path, const TriangleSource& source, const SurfaceFacts& facts,
           const JobContext& job) {
  detail::OutputFile out(path);
  write_header(out, source, facts);
  detail::Records records;
  std::vector<std::array<float, 3>> normals;
  detail::in_parts<std::array<double, 3>>(
      source.vertices,
      [&](std::uint64_t first, std::span<std::array<double, 3>> part) {
        source.positions(first, part);
        normals.resize(source.has_normals ? part.size() : 0);
        if (source.has_normals) source.normals(first, normals);
      },
      [&](std::span<const std::array<double, 3>> part) {
        job.check();
        records.clear();
        for (std::size_t n = 0; n < part.size(); ++n) {
          records.put(part[n]);
          if (source.has_normals) records.put(normals[n]);
        }
        out.write(records.bytes());
      });
  detail::write_triangles(out, source, job, [](detail::Records& to, const auto& corners) {
    to.put(std::uint8_t{3});
    to.put(corners);
  });
  out.commit();
}

}  // namespace footwall::formats::ply
