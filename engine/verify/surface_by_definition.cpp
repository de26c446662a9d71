#include "engine/verify/surface_by_definition.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <vector>

#include "engine/isosurface/case_tables.h"

namespace footwall::verify {
namespace {

using namespace isosurface;
using Coordinates = std::array<std::int64_t, 3>;

// In the order of Surface: row, then k edges, j edges, i edges and centres, then k.
struct Place {
  std::int64_t i = 0;
  std::int64_t j = 0;
  int kind = 0;  // 2 - axis, or 3 for a centre
  std::int64_t k = 0;
  friend auto operator<=>(const Place&, const Place&) = default;
};

struct Vertex {
  Point position;
  Point normal;
};

struct Marched {
  const Field& field;
  float isovalue;
  std::map<Place, Vertex> vertices;
  std::vector<std::array<Place, 3>> triangles;

  // By the volume's coordinates.
  bool has(const Coordinates& p) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (p[axis] < field.origin[axis] || p[axis] >= field.origin[axis] + field.size[axis]) return false;
    }
    return true;
  }
  float value(const Coordinates& p) const {
    const std::int64_t i = p[0] - field.origin[0];
    const std::int64_t j = p[1] - field.origin[1];
    const std::int64_t k = p[2] - field.origin[2];
    return field.values[static_cast<std::size_t>((i * field.size[1] + j) * field.size[2] + k)];
  }

  // Twice the derivative; a neighbour that is not there, or null, is replaced by the sample, and a difference
  // over one step counts twice.
  float rise(Coordinates p, int axis) const {
    const float here = value(p);
    int missing = 0;
    const auto side = [&](int way) {
      Coordinates q = p;
      q[axis] += way;
      if (has(q) && !std::isnan(value(q))) return value(q);
      ++missing;
      return here;
    };
    const float above = side(1);
    const float below = side(-1);
    return missing == 1 ? 2 * (above - below) : above - below;
  }

  Vertex on_edge(const Coordinates& low, int axis) const {
    Coordinates high = low;
    ++high[axis];
    const float a = value(low);
    const float b = value(high);
    float t = (isovalue - a) / (b - a);
    if (std::isnan(t) || t > 1 - 1.0F / 1024) t = 1 - 1.0F / 1024;
    if (t < 1.0F / 1024) t = 1.0F / 1024;
    std::array<float, 3> position{};
    std::array<float, 3> g{};
    float most = 0;
    bool number = true;
    for (int n = 0; n < 3; ++n) {
      position[n] = static_cast<float>(low[n]);
      const float g0 = rise(low, n);
      const float g1 = rise(high, n);
      g[n] = g0 + t * (g1 - g0);
      most = std::max(most, std::abs(g[n]));
      if (!std::isfinite(g[n])) number = false;
    }
    position[axis] += t;
    std::array<float, 3> normal{};
    if (!number || most == 0) {
      normal[axis] = a >= isovalue ? 1.0F : -1.0F;
    } else {
      int exponent = 0;
      std::frexp(most, &exponent);
      for (float& each : g) each = std::ldexp(each, -std::min(exponent, 126));
      const float length = std::sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
      for (int n = 0; n < 3; ++n) normal[n] = g[n] * (-1 / length);
    }
    return {{position[0], position[1], position[2]}, {normal[0], normal[1], normal[2]}};
  }

  Vertex in_centre(const std::vector<Place>& loop) const {
    std::array<double, 3> position{};
    std::array<double, 3> normal{};
    for (const Place& place : loop) {
      const Vertex& vertex = vertices.at(place);
      position = {position[0] + vertex.position.i, position[1] + vertex.position.j,
                  position[2] + vertex.position.k};
      normal = {normal[0] + vertex.normal.i, normal[1] + vertex.normal.j, normal[2] + vertex.normal.k};
    }
    const auto over = [](const std::array<double, 3>& v, double by) {
      return Point{static_cast<float>(v[0] / by), static_cast<float>(v[1] / by),
                   static_cast<float>(v[2] / by)};
    };
    const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    return {over(position, static_cast<double>(loop.size())),
            length == 0 ? vertices.at(loop.front()).normal : over(normal, length)};
  }

  void march(const Coordinates& cell) {
    std::array<float, 8> values{};
    unsigned signs = 0;
    for (unsigned c = 0; c < 8; ++c) {
      values[c] = value({cell[0] + (c & 1U), cell[1] + (c >> 1U & 1U), cell[2] + (c >> 2U)});
      if (std::isnan(values[c])) return;
      if (values[c] >= isovalue) signs |= 1U << c;
    }
    const Alternative alternative = is_undecided(signs) ? decide(signs, values, isovalue) : Alternative{0};
    const Pattern& pattern = pattern_of(signs, alternative);
    const auto place_of = [&](int edge) {
      if (edge == kCentre) return Place{cell[0], cell[1], 3, cell[2]};
      const int axis = edge / 4;
      Coordinates low = cell;
      low[axis == 0 ? 1 : 0] += edge & 1;
      low[axis == 2 ? 1 : 2] += edge >> 1 & 1;
      return Place{low[0], low[1], 2 - axis, low[2]};
    };
    for (const auto& triangle : pattern.triangles) {
      for (const std::uint8_t edge : triangle) {
        const Place place = place_of(edge);
        if (edge != kCentre && !vertices.contains(place)) {
          vertices[place] = on_edge({place.i, place.j, place.k}, edge / 4);
        }
      }
      triangles.push_back({place_of(triangle[0]), place_of(triangle[1]), place_of(triangle[2])});
    }
    if (!pattern.has_centre) return;
    std::vector<Place> loop;
    for (int edge = 0; edge < kCentre; ++edge) {
      if ((pattern.centre_edges >> edge & 1) != 0) loop.push_back(place_of(edge));
    }
    vertices[place_of(kCentre)] = in_centre(loop);
  }
};

bool same(const Point& a, const Point& b) {
  const auto bits = [](float f) { return std::bit_cast<std::uint32_t>(f); };
  return bits(a.i) == bits(b.i) && bits(a.j) == bits(b.j) && bits(a.k) == bits(b.k);
}

std::string text(const Point& p) {
  return fmt::format("({}, {}, {})", p.i, p.j, p.k);
}

}  // namespace

Surface surface_by_definition(const Field& field, float isovalue, const ExtractOptions& options) {
  Surface surface;
  surface.cells = options.cells.value_or(cells_of(field));
  Marched marched{field, isovalue, {}, {}};
  const survey::Box& cells = surface.cells;
  for (std::int64_t i = cells.lo[0]; i < cells.hi[0]; ++i) {
    for (std::int64_t j = cells.lo[1]; j < cells.hi[1]; ++j) {
      surface.row_first.push_back(marched.triangles.size());
      for (std::int64_t k = cells.lo[2]; k < cells.hi[2]; ++k) marched.march({i, j, k});
    }
  }
  surface.row_first.push_back(marched.triangles.size());

  std::map<Place, std::uint32_t> number;
  surface.positions.resize_uninitialised(marched.vertices.size());
  surface.normals.resize_uninitialised(marched.vertices.size());
  surface.keys.resize_uninitialised(marched.vertices.size());
  for (const auto& [place, vertex] : marched.vertices) {
    const auto n = static_cast<std::uint32_t>(number.size());
    number[place] = n;
    surface.positions[n] = vertex.position;
    surface.normals[n] = vertex.normal;
    const std::int64_t sample = (place.i * field.volume_size[1] + place.j) * field.volume_size[2] + place.k;
    surface.keys[n] =
        4 * static_cast<VertexKey>(sample) + static_cast<VertexKey>(place.kind == 3 ? 3 : 2 - place.kind);
  }
  surface.triangles.resize_uninitialised(marched.triangles.size());
  for (std::size_t t = 0; t < marched.triangles.size(); ++t) {
    const auto& corners = marched.triangles[t];
    surface.triangles[t] = {number.at(corners[0]), number.at(corners[1]), number.at(corners[2])};
  }
  return surface;
}

std::string difference(const Surface& made, const Surface& defined) {
  if (made.cells != defined.cells) return "other cells";
  if (made.positions.size() != defined.positions.size()) {
    return fmt::format("{} vertices instead of {}", made.positions.size(), defined.positions.size());
  }
  if (made.triangles.size() != defined.triangles.size()) {
    return fmt::format("{} triangles instead of {}", made.triangles.size(), defined.triangles.size());
  }
  if (!made.normals.empty() && made.normals.size() != defined.normals.size())
    return "some normals are missing";
  if (!made.keys.empty() && made.keys.size() != defined.keys.size()) return "some keys are missing";
  for (std::size_t n = 0; n < made.positions.size(); ++n) {
    if (!same(made.positions[n], defined.positions[n])) {
      return fmt::format("vertex {} at {} instead of {}", n, text(made.positions[n]),
                         text(defined.positions[n]));
    }
    if (!made.normals.empty() && !same(made.normals[n], defined.normals[n])) {
      return fmt::format("normal {} is {} instead of {}, at {}", n, text(made.normals[n]),
                         text(defined.normals[n]), text(made.positions[n]));
    }
    if (!made.keys.empty() && made.keys[n] != defined.keys[n]) {
      return fmt::format("key {} is {} instead of {}", n, made.keys[n], defined.keys[n]);
    }
  }
  for (std::size_t t = 0; t < made.triangles.size(); ++t) {
    if (made.triangles[t] != defined.triangles[t]) {
      const auto& a = made.triangles[t];
      const auto& b = defined.triangles[t];
      return fmt::format("triangle {} is {} {} {} instead of {} {} {}", t, a[0], a[1], a[2], b[0], b[1],
                         b[2]);
    }
  }
  if (made.row_first != defined.row_first) return "other rows";
  return {};
}

std::string unsoundness(const Surface& surface) {
  std::vector<bool> used(surface.positions.size(), false);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    std::array<std::array<double, 3>, 3> corner{};
    for (std::size_t n = 0; n < 3; ++n) {
      const std::uint32_t vertex = surface.triangles[t][n];
      if (vertex >= used.size())
        return fmt::format("triangle {} has vertex {} of {}", t, vertex, used.size());
      used[vertex] = true;
      const Point& p = surface.positions[vertex];
      corner[n] = {p.i, p.j, p.k};
    }
    std::array<double, 3> u{};
    std::array<double, 3> v{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      u[axis] = corner[1][axis] - corner[0][axis];
      v[axis] = corner[2][axis] - corner[0][axis];
    }
    const double area =
        std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
    if (!(area > 0)) return fmt::format("triangle {} has no area", t);
  }
  for (std::size_t n = 0; n < used.size(); ++n) {
    const Point& p = surface.positions[n];
    if (!used[n]) return fmt::format("vertex {} is of no triangle", n);
    if (!std::isfinite(p.i) || !std::isfinite(p.j) || !std::isfinite(p.k)) {
      return fmt::format("vertex {} stands at {}", n, text(p));
    }
    if (surface.normals.empty()) continue;
    const Point& normal = surface.normals[n];
    if (!(std::abs(std::hypot(normal.i, normal.j, normal.k) - 1) < 1e-5F)) {
      return fmt::format("normal {} is {}", n, text(normal));
    }
  }
  return {};
}

}  // namespace footwall::verify
