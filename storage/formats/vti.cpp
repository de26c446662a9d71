#include "storage/formats/vti.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "storage/base/error.h"
#include "storage/formats/detail/output_file.h"
#include "storage/formats/detail/sample_grid.h"
#include "storage/formats/detail/xml.h"

namespace footwall::formats::vti {
namespace {

struct Field {
  std::string name;
  std::string value;  // with its end mark
};

std::vector<Field> fields_of(const survey::Geometry& geometry, const Options& options) {
  const auto lines = [](const survey::LineAxis& axis) { return fmt::format("{} {}", axis.first, axis.step); };
  std::vector<Field> fields{{"vertical_unit", std::string(name_of(geometry.vertical_unit))},
                            {"horizontal_unit", geometry.horizontal_unit},
                            {"z_positive", options.z_up ? "up" : "down"},
                            {"domain", std::string(name_of(geometry.domain))},
                            {"crs", geometry.crs},
                            {"inlines_first_step", lines(geometry.inlines)},
                            {"crosslines_first_step", lines(geometry.crosslines)}};
  for (Field& field : fields) {
    std::erase(field.value, '\0');
    field.value.push_back('\0');
  }
  return fields;
}

}  // namespace

void write(const std::filesystem::path& path, const survey::Geometry& geometry, const raw::BoxReader& read,
           const Options& options, const JobContext& job) {
  geometry.validate();
  const survey::Index dims = geometry.dims();
  const survey::MapView& map = geometry.map;
  const double up = options.z_up ? -1 : 1;
  const double i_length = std::hypot(map.per_inline_x, map.per_inline_y);
  const double j_length = std::hypot(map.per_crossline_x, map.per_crossline_y);
  // Columns are the directions of inlines, crosslines and samples.
  const std::array<double, 9> direction{map.per_inline_x / i_length,
                                        map.per_crossline_x / j_length,
                                        0,
                                        map.per_inline_y / i_length,
                                        map.per_crossline_y / j_length,
                                        0,
                                        0,
                                        0,
                                        up};
  const std::string extent = fmt::format("0 {} 0 {} 0 {}", dims[0] - 1, dims[1] - 1, dims[2] - 1);
  const std::vector<Field> fields = fields_of(geometry, options);

  detail::OutputFile out(path);
  out.print(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n");
  out.print("<ImageData WholeExtent=\"{}\" Origin=\"{} {} {}\" Spacing=\"{} {} {}\" Direction=\"{}\">\n",
            extent, map.origin_x, map.origin_y, up * geometry.z0, i_length, j_length, geometry.interval,
            fmt::join(direction, " "));
  out.print("<FieldData>\n");
  std::uint64_t offset = 0;
  for (const Field& field : fields) {
    out.print(
        "<DataArray type=\"String\" Name=\"{}\" NumberOfTuples=\"1\" format=\"appended\" offset=\"{}\"/>\n",
        field.name, offset);
    offset += sizeof(std::uint64_t) + field.value.size();
  }
  const std::string name = detail::xml_escaped(options.name);
  out.print("</FieldData>\n<Piece Extent=\"{}\">\n<PointData Scalars=\"{}\">\n", extent, name);
  out.print("<DataArray type=\"Float32\" Name=\"{}\" format=\"appended\" offset=\"{}\"/>\n", name, offset);
  out.print("</PointData>\n</Piece>\n</ImageData>\n<AppendedData encoding=\"raw\">\n_");
  const auto put_size = [&](std::uint64_t bytes) { out.write(std::as_bytes(std::span(&bytes, 1))); };
  for (const Field& field : fields) {
    put_size(field.value.size());
    out.write(std::string_view(field.value));
  }
  put_size(static_cast<std::uint64_t>(dims[0]) * static_cast<std::uint64_t>(dims[1]) *
           static_cast<std::uint64_t>(dims[2]) * sizeof(float));
  detail::write_samples(out, dims, {2, 1, 0}, false, read, 32, "write VTI", job);
  out.print("\n</AppendedData>\n</VTKFile>\n");
  out.commit();
}

}  // namespace footwall::formats::vti
