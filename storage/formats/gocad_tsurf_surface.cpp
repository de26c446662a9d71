#include "storage/formats/detail/in_parts.h"
#include "storage/formats/detail/output_file.h"
#include "storage/formats/gocad_tsurf.h"

namespace footwall::formats::gocad_tsurf {

void write_surface(const std::filesystem::path& path, const TriangleSource& source, const SurfaceFacts& facts,
                   const JobContext& job) {
  detail::OutputFile out(path);
  std::string name;
  for (const char letter : facts.name) {
    const bool plain = static_cast<unsigned char>(letter) >= 0x20 && letter != '{' && letter != '}';
    name += plain ? letter : ' ';
  }
  out.print("GOCAD TSurf 1\nHEADER {{\nname:{}\n}}\n", name);
  out.print(
      "GOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nAXIS_NAME \"X\" \"Y\" \"Z\"\n"
      "AXIS_UNIT \"{0}\" \"{0}\" \"{1}\"\nZPOSITIVE {2}\nEND_ORIGINAL_COORDINATE_SYSTEM\nTFACE\n",
      facts.horizontal_unit, facts.vertical_unit, facts.z_positive == "up" ? "Elevation" : "Depth");
  std::uint64_t number = 0;
  detail::in_parts<std::array<double, 3>>(source.vertices, source.positions,
                                          [&](std::span<const std::array<double, 3>> part) {
                                            job.check();
                                            for (const auto& [x, y, z] : part)
                                              out.print("VRTX {} {:.6f} {:.6f} {:.6f}\n", ++number, x, y, z);
                                          });
  detail::in_parts<std::array<std::uint32_t, 3>>(
      source.triangles, source.corners, [&](std::span<const std::array<std::uint32_t, 3>> part) {
        job.check();
        for (const auto& [a, b, c] : part) {
          out.print("TRGL {} {} {}\n", std::uint64_t{a} + 1, std::uint64_t{b} + 1, std::uint64_t{c} + 1);
        }
      });
  out.write("END\n");
  out.commit();
}

}  // namespace footwall::formats::gocad_tsurf
