// Lines that tell surfaces apart where their faces show a statistic: a mesh's border, and where it cuts a
// section.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "engine/render/rasterizer.h"
#include "engine/render/scene_frame.h"

namespace footwall::render {

// Pairs of points: edges that have one triangle only.
std::vector<Vec3> border_of(std::span<const Vec3> vertices, std::span<const TriangleIndices> triangles);

// Pairs of points: where the surface meets the plane (index coordinate `axis`) = at.
std::vector<Vec3> cut_of(const SceneFrame& frame, std::span<const survey::IndexPoint> vertices,
                         std::span<const TriangleIndices> triangles, int axis, double at);

}  // namespace footwall::render
