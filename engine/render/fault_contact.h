// Where faults cut each other: without that line two surfaces of the same colours melt into one.
#pragma once
#include <span>
#include <vector>

#include "engine/render/rasterizer.h"

namespace footwall::render {

struct Triangles {
  std::span<const Vec3> vertices;
  std::span<const TriangleIndices> triangles;
};

// Pairs of points: the segments in which triangles of one surface cut those of another. Triangles with a
// vertex that is not finite, and those that lie in one plane, cut nothing. Nothing at all for more triangles
// than kMostTrianglesForContacts: looking for contacts would take longer than the picture.
std::vector<Vec3> contacts_of(std::span<const Triangles> surfaces);
inline constexpr std::size_t kMostTrianglesForContacts = 500'000;

}  // namespace footwall::render
