// A flat sheet of 2 x rows x columns triangles, vertex (r, c) is number r * (columns + 1) + c.
#pragma once
#include "engine/mesh/mesh.h"

namespace footwall::mesh::testing {

struct Sheet {
  std::vector<survey::IndexPoint> positions;
  std::vector<std::array<VertexId, 3>> faces;
};

inline Sheet sheet(int rows, int columns) {
  Sheet s;
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= columns; ++c) s.positions.push_back({double(r), double(c), 0.0});
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const VertexId a = r * (columns + 1) + c, b = a + 1, d = a + columns + 1, e = d + 1;
      s.faces.push_back({a, d, e});
      s.faces.push_back({a, e, b});
    }
  }
  return s;
}

inline Mesh sheet_mesh(int rows, int columns) {
  const Sheet s = sheet(rows, columns);
  return Mesh(s.positions, s.faces);
}

}  // namespace footwall::mesh::testing
