// A surface of many triangles as its writers take it: in parts, as they need them, so that nobody has to hold
// it in the form of a file, or at all.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace footwall::formats {

struct TriangleSource {
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  bool has_normals = false;

  // Each fills `into` from number `first` on; asked for in ascending order, each number once, in parts of at
  // most kPart. x, y, z as they are to stand in the file.
  std::function<void(std::uint64_t first, std::span<std::array<double, 3>> into)> positions;
  std::function<void(std::uint64_t first, std::span<std::array<float, 3>> into)> normals;
  // Numbers of vertices; counter-clockwise as seen from the side that the normals point to.
  std::function<void(std::uint64_t first, std::span<std::array<std::uint32_t, 3>> into)> corners;

  static constexpr std::uint64_t kPart = 1 << 16;
};

// What the file says about it, where its format has room for that.
struct SurfaceFacts {
  std::string name;
  std::string horizontal_unit = "m";  // of x and y: "m", "ft", "voxel"
  std::string vertical_unit = "m";    // of z: "ms", "m", "ft", "voxel"
  std::string z_positive = "up";      // or "down"
  std::string crs;
};

}  // namespace footwall::formats
