// A triangulated sheet in index space that can be cut to where it is true.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "storage/survey/points.h"

namespace footwall::synthetic::detail {

struct Sheet {
  std::vector<survey::IndexPoint> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;
};

// A grid of a_cells x b_cells cells, two triangles each; at(a, b) is the position of a grid node.
Sheet grid_sheet(int a_cells, int b_cells, const std::function<survey::IndexPoint(int, int)>& at);

// The part where value(vertex) >= 0, with value linear on every edge. Triangles keep their winding, and
// neighbours share the new vertices. A value and its negative cut along identical vertices.
Sheet clipped(const Sheet& sheet, const std::function<double(const survey::IndexPoint&)>& value);

// Both sheets as one; vertices at exactly the same place become one.
Sheet joined(const Sheet& a, const Sheet& b);

}  // namespace footwall::synthetic::detail
