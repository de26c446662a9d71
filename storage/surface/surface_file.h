// Triangle surfaces as HDF5: /positions [vertex][3], float32 in index space or float64 in the world; /normals
// [vertex][3], float32, where the surface has them; /triangles [triangle][3], uint32 into the vertices. The
// attributes footwall_surface (the format's version, "1") and description (JSON: what it is) stand at the
// root.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace footwall::surface {

inline constexpr const char* kVersion = "1";

struct StoredSurface {
  std::string description;        // JSON
  bool world = false;             // positions are world coordinates
  std::vector<double> positions;  // three a vertex
  std::vector<float> normals;     // three a vertex, or none
  std::vector<std::uint32_t> triangles;
};

// Throws kNotFound, kFormat (not a surface file; indices beyond the vertices; too large for this machine's
// memory as its sizes say), kUnsupported (a newer version), kCorrupt.
StoredSurface read_surface(const std::filesystem::path& path);

}  // namespace footwall::surface
