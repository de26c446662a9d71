#include <fmt/format.h>

#include "storage/formats/detail/output_file.h"
#include "storage/formats/detail/sample_grid.h"
#include "storage/formats/nrrd.h"

namespace footwall::formats::nrrd {
namespace {

// Values stand on one line.
std::string one_line(std::string text) {
  for (char& letter : text) {
    if (static_cast<unsigned char>(letter) < 0x20) letter = ' ';
  }
  return text;
}

}  // namespace

void write(const std::filesystem::path& path, const survey::Geometry& geometry, const raw::AxisOrder& order,
           const std::string& content, const raw::BoxReader& read, const JobContext& job) {
  const survey::Index dims = geometry.dims();
  const survey::MapView& map = geometry.map;
  const std::string directions[] = {fmt::format("({},{},0)", map.per_inline_x, map.per_inline_y),
                                    fmt::format("({},{},0)", map.per_crossline_x, map.per_crossline_y),
                                    fmt::format("(0,0,{})", geometry.interval)};
  const std::string unit(name_of(geometry.vertical_unit));
  const auto fast = static_cast<std::size_t>(order[2]);
  const auto middle = static_cast<std::size_t>(order[1]);
  const auto slow = static_cast<std::size_t>(order[0]);
  constexpr std::string_view kNames[] = {"inline", "crossline", "sample"};
  detail::OutputFile out(path);
  out.print("NRRD0005\n# written by Footwall: x and y of the space as the survey's, z positive down\n");
  if (!content.empty()) out.print("content: {}\n", one_line(content));
  out.print("type: float\ndimension: 3\nspace dimension: 3\nsizes: {} {} {}\n", dims[fast], dims[middle],
            dims[slow]);
  out.print("space directions: {} {} {}\n", directions[fast], directions[middle], directions[slow]);
  out.print("labels: \"{}\" \"{}\" \"{}\"\n", kNames[fast], kNames[middle], kNames[slow]);
  out.print("kinds: domain domain domain\nencoding: raw\nendian: little\n");
  out.print("space units: \"{0}\" \"{0}\" \"{1}\"\nspace origin: ({2},{3},{4})\n", geometry.horizontal_unit,
            unit, map.origin_x, map.origin_y, geometry.z0);
  out.print("footwall inlines:={} {}\nfootwall crosslines:={} {}\nfootwall z:=down\n", geometry.inlines.first,
            geometry.inlines.step, geometry.crosslines.first, geometry.crosslines.step);
  if (!geometry.crs.empty()) out.print("footwall crs:={}\n", one_line(geometry.crs));
  out.print("\n");
  detail::write_samples(out, dims, order, false, read, 32, "write NRRD", job);
  out.commit();
}

}  // namespace footwall::formats::nrrd
