// Based on: the binary form of 3D Systems' StereoLithography Interface Specification, 1989: 80 bytes of text,
// the number of facets, 50 bytes a facet.
#include "storage/formats/stl.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <limits>

#include "storage/base/error.h"
#include "storage/formats/detail/in_parts.h"
#include "storage/formats/detail/output_file.h"

namespace footwall::formats::stl {
namespace {

static_assert(std::endian::native == std::endian::little, "STL is little-endian");

using Position = std::array<float, 3>;

Position normal_of(const Position& a, const Position& b, const Position& c) {
  std::array<double, 3> u, v, n;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    u[axis] = static_cast<double>(b[axis]) - a[axis];
    v[axis] = static_cast<double>(c[axis]) - a[axis];
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
    n[axis] = u[next] * v[last] - u[last] * v[next];
  }
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  if (!(length > 0)) return {0, 0, 0};
  return {static_cast<float>(n[0] / length), static_cast<float>(n[1] / length),
          static_cast<float>(n[2] / length)};
}

}  // namespace

void write(const std::filesystem::path& path, const TriangleSource& source, const SurfaceFacts& facts,
           const JobContext& job) {
  if (source.triangles > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::kUnsupported, "STL counts triangles with 32 bits: the surface has too many",
                "write .vtp or .ply");
  }
  std::vector<Position> positions;
  positions.reserve(source.vertices);
  detail::in_parts<std::array<double, 3>>(
      source.vertices, source.positions, [&](std::span<const std::array<double, 3>> part) {
        job.check();
        for (const auto& p : part) {
          positions.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
        }
      });
  detail::OutputFile out(path);
  // A text that begins with "solid" would be taken for the other form of STL.
  std::string text = fmt::format("Footwall {} ({}, {}, z {})", facts.name, facts.horizontal_unit,
                                 facts.vertical_unit, facts.z_positive);
  text.resize(80, ' ');
  out.write(text);
  detail::Records records;
  records.put(static_cast<std::uint32_t>(source.triangles));
  out.write(records.bytes());
  detail::write_triangles(out, source, job, [&](detail::Records& to, const auto& corners) {
    const auto [a, b, c] = corners;
    require(a < positions.size() && b < positions.size() && c < positions.size(),
            "triangles of vertices that are there");
    to.put(normal_of(positions[a], positions[b], positions[c]));
    to.put(positions[a]);
    to.put(positions[b]);
    to.put(positions[c]);
    to.put(std::uint16_t{0});
  });
  out.commit();
}

}  // namespace footwall::formats::stl
