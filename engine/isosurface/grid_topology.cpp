#include "engine/isosurface/grid_topology.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace footwall::isosurface {
namespace {

VertexKey key_of(const survey::Index& at, int axis, const survey::Index& size) {
  return static_cast<VertexKey>(((at[0] * size[1] + at[1]) * size[2] + at[2]) * 4 + axis);
}

// The vertex of a cell, by its number in the patterns.
VertexKey key_of(const survey::Index& cell, std::uint8_t vertex, const survey::Index& size) {
  if (vertex == kCentre) return key_of(cell, 3, size);
  const int axis = vertex / 4;
  survey::Index at = cell;
  at[axis == 0 ? 1 : 0] += vertex & 1;
  at[axis == 2 ? 1 : 2] += vertex >> 1 & 1;
  return key_of(at, axis, size);
}

// Bit 2 * axis + side: the vertex lies on that side of the volume.
unsigned sides_of(VertexKey key, const survey::Index& size) {
  const int axis = static_cast<int>(key % 4);
  if (axis == 3) return 0;
  auto rest = static_cast<std::int64_t>(key / 4);
  unsigned sides = 0;
  for (int each = 2; each >= 0; --each) {
    const std::int64_t place = rest % size[each];
    rest /= size[each];
    if (each == axis) continue;
    if (place == 0) sides |= 1U << (2 * each);
    if (place == size[each] - 1) sides |= 2U << (2 * each);
  }
  return sides;
}

class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }
  void unite(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }
  std::int64_t count(const std::vector<bool>& of) {
    std::int64_t roots = 0;
    for (std::size_t n = 0; n < parent_.size(); ++n) roots += of[n] && parent_[n] == n ? 1 : 0;
    return roots;
  }

 private:
  std::size_t root(std::size_t n) {
    while (parent_[n] != n) n = parent_[n] = parent_[parent_[n]];
    return n;
  }
  std::vector<std::size_t> parent_;
};

}  // namespace

std::vector<KeyTriangle> triangles_by_cell(const Field& field, float isovalue, const CaseRules& rules) {
  std::vector<KeyTriangle> triangles;
  const survey::Box cells = cells_of(field);
  for (std::int64_t i = cells.lo[0]; i < cells.hi[0]; ++i) {
    for (std::int64_t j = cells.lo[1]; j < cells.hi[1]; ++j) {
      for (std::int64_t k = cells.lo[2]; k < cells.hi[2]; ++k) {
        std::array<float, 8> values{};
        unsigned signs = 0;
        bool has_null = false;
        for (unsigned c = 0; c < 8; ++c) {
          const std::int64_t at =
              ((i - field.origin[0] + (c & 1U)) * field.size[1] + j - field.origin[1] + (c >> 1 & 1U)) *
                  field.size[2] +
              k - field.origin[2] + (c >> 2);
          values[c] = field.values[static_cast<std::size_t>(at)];
          has_null = has_null || std::isnan(values[c]);
          signs |= values[c] >= isovalue ? 1U << c : 0U;
        }
        if (has_null) continue;
        const Alternative alternative =
            rules.undecided(signs) ? rules.decide(signs, values, isovalue) : Alternative{0};
        for (const auto& [a, b, c] : rules.pattern(signs, alternative).triangles) {
          const survey::Index cell{i, j, k};
          triangles.push_back({key_of(cell, a, field.volume_size), key_of(cell, b, field.volume_size),
                               key_of(cell, c, field.volume_size)});
        }
      }
    }
  }
  return triangles;
}

SurfaceForm form_of(std::span<const KeyTriangle> triangles, const survey::Index& volume_size) {
  struct Uses {
    int forward = 0;
    int backward = 0;
  };
  std::map<VertexKey, std::size_t> numbers;
  std::map<std::pair<VertexKey, VertexKey>, Uses> edges;
  for (const KeyTriangle& triangle : triangles) {
    for (std::size_t n = 0; n < 3; ++n) {
      const VertexKey from = triangle[n];
      const VertexKey to = triangle[(n + 1) % 3];
      numbers.emplace(from, numbers.size());
      Uses& uses = edges[std::minmax(from, to)];
      ++(from < to ? uses.forward : uses.backward);
    }
  }
  SurfaceForm form;
  Sets parts(numbers.size());
  Sets rims(numbers.size());
  std::vector<bool> on_rim(numbers.size(), false);
  for (const auto& [ends, uses] : edges) {
    const std::size_t a = numbers.at(ends.first);
    const std::size_t b = numbers.at(ends.second);
    parts.unite(a, b);
    const int all = uses.forward + uses.backward;
    form.crowded_edges += all > 2 ? 1 : 0;
    form.twisted_edges += all == 2 && uses.forward != 1 ? 1 : 0;
    if (all != 1) continue;
    rims.unite(a, b);
    on_rim[a] = on_rim[b] = true;
    const bool border = (sides_of(ends.first, volume_size) & sides_of(ends.second, volume_size)) != 0;
    ++(border ? form.border_edges : form.open_edges);
  }
  form.vertices = static_cast<std::int64_t>(numbers.size());
  form.triangles = static_cast<std::int64_t>(triangles.size());
  form.components = parts.count(std::vector<bool>(numbers.size(), true));
  form.euler = form.vertices - static_cast<std::int64_t>(edges.size()) + form.triangles;
  form.genus = form.components - (form.euler + rims.count(on_rim)) / 2;
  return form;
}

}  // namespace footwall::isosurface
