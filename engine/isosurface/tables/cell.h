// The corners, edges and faces of a cell, numbered as in case_tables.h.
#pragma once
#include <array>
#include <bit>

namespace footwall::isosurface::tables {

inline constexpr int kCentreVertex = 12;

constexpr int axis_of(int edge) {
  return edge / 4;
}
// The two axes other than `axis`, ascending.
constexpr std::array<int, 2> others(int axis) {
  return {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2};
}

constexpr int lower_corner(int edge) {
  const std::array<int, 2> across = others(axis_of(edge));
  const int n = edge % 4;
  return (n & 1) << across[0] | (n >> 1) << across[1];
}
constexpr int upper_corner(int edge) {
  return lower_corner(edge) | 1 << axis_of(edge);
}

// The edge between two neighbouring corners.
constexpr int edge_between(int a, int b) {
  const int axis = std::countr_zero(static_cast<unsigned>(a ^ b));
  const std::array<int, 2> across = others(axis);
  const int low = a & b;
  return 4 * axis + ((low >> across[0] & 1) | (low >> across[1] & 1) << 1);
}

// Bit f: the edge lies on the face f.
constexpr unsigned faces_of(int edge) {
  unsigned faces = 0;
  for (const int axis : others(axis_of(edge))) faces |= 1U << (2 * axis + (lower_corner(edge) >> axis & 1));
  return faces;
}

// Counter-clockwise as seen from outside the cell.
constexpr std::array<int, 4> corners_of(int face) {
  const int axis = face / 2;
  const int u = 1 << (axis + 1) % 3;
  const int v = 1 << (axis + 2) % 3;
  const int base = (face & 1) << axis;
  if ((face & 1) != 0) return {base, base | u, base | u | v, base | v};
  return {base, base | v, base | u | v, base | u};
}

// A chord between two vertices on a common face of the cell (which is not a contour there): the six that four
// vertices can have are dealt out between the two cells of the face, so that they never have the same one and
// no edge has four triangles. The cell above gets those at the vertex that stands first on the face.
constexpr bool may_be_chord(int face, int a, int b) {
  const int base = (face & 1) << face / 2;
  const int first = edge_between(base, base | 1 << others(face / 2)[0]);
  return (a == first || b == first) == ((face & 1) == 0);
}

constexpr bool is_inside(unsigned signs, int corner) {
  return (signs >> corner & 1) != 0;
}

constexpr bool is_cut(unsigned signs, int edge) {
  return is_inside(signs, lower_corner(edge)) != is_inside(signs, upper_corner(edge));
}

constexpr unsigned ambiguous_faces(unsigned signs) {
  unsigned faces = 0;
  for (int face = 0; face < 6; ++face) {
    const std::array<int, 4> ring = corners_of(face);
    const bool first = is_inside(signs, ring[0]);
    if (is_inside(signs, ring[2]) == first && is_inside(signs, ring[1]) != first &&
        is_inside(signs, ring[3]) != first)
      faces |= 1U << face;
  }
  return faces;
}

}  // namespace footwall::isosurface::tables
