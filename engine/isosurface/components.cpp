#include "engine/isosurface/components.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/isosurface/edges.h"
#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

// Sets of vertices; the smallest number of a set stands for it.
class Sets {
 public:
  explicit Sets(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }
  std::uint32_t root_of(std::uint32_t n) {
    while (parent_[n] != n) {
      parent_[n] = parent_[parent_[n]];
      n = parent_[n];
    }
    return n;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root_of(a);
    b = root_of(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

void take_in(ComponentTally& tally, const Point& p) {
  if (tally.vertices == 0) {
    tally.lo = tally.hi = p;
  } else {
    tally.lo = {std::min(tally.lo.i, p.i), std::min(tally.lo.j, p.j), std::min(tally.lo.k, p.k)};
    tally.hi = {std::max(tally.hi.i, p.i), std::max(tally.hi.j, p.j), std::max(tally.hi.k, p.k)};
  }
}

template <class Value>
PageVector<Value> picked(const PageVector<Value>& all, const std::vector<std::uint32_t>& order) {
  PageVector<Value> some;
  some.resize_uninitialised(order.size());
  for (std::size_t n = 0; n < order.size(); ++n) some[n] = all[order[n]];
  return some;
}

}  // namespace

Components components_of(const Surface& surface) {
  const std::size_t vertices = surface.positions.size();
  Sets sets(vertices);
  for (const Triangle& triangle : surface.triangles.all()) {
    sets.join(triangle[0], triangle[1]);
    sets.join(triangle[1], triangle[2]);
  }
  Components components;
  components.of_vertex.resize(vertices);
  // The root of a set comes before its other members.
  for (std::uint32_t n = 0; n < vertices; ++n) {
    const std::uint32_t root = sets.root_of(n);
    components.of_vertex[n] = root == n ? components.count++ : components.of_vertex[root];
  }
  return components;
}

void ComponentTally::merge(const ComponentTally& other) {
  if (other.vertices > 0) {
    if (vertices == 0) {
      first = other.first;
      lo = other.lo;
      hi = other.hi;
    } else {
      first = std::min(first, other.first);
      take_in(*this, other.lo);
      take_in(*this, other.hi);
    }
  }
  vertices += other.vertices;
  edges += other.edges;
  triangles += other.triangles;
  boundary_edges += other.boundary_edges;
  non_manifold_edges += other.non_manifold_edges;
  area.merge(other.area);
  volume.merge(other.volume);
}

std::vector<ComponentTally> tallies_of(const Surface& surface, const Components& components,
                                       const Measure& measure) {
  require(components.of_vertex.size() == surface.positions.size(), "components of this surface");
  std::vector<ComponentTally> tallies(components.count);
  for (std::uint32_t n = 0; n < components.of_vertex.size(); ++n) {
    ComponentTally& tally = tallies[components.of_vertex[n]];
    const VertexKey name = surface.keys.empty() ? n : surface.keys[n];
    tally.first = tally.vertices == 0 ? name : std::min(tally.first, name);
    take_in(tally, surface.positions[n]);
    ++tally.vertices;
  }
  const auto positions = surface.positions.all();
  for (const Triangle& triangle : surface.triangles.all()) {
    ComponentTally& tally = tallies[components.of_vertex[triangle[0]]];
    const Point &a = positions[triangle[0]], &b = positions[triangle[1]], &c = positions[triangle[2]];
    ++tally.triangles;
    tally.area.add(measure.area(a, b, c));
    tally.volume.add(Measure::volume(a, b, c));
  }
  for_each_edge(surface, [&](const Edge& edge) {
    ComponentTally& tally = tallies[components.of_vertex[edge.a]];
    ++tally.edges;
    if (edge.boundary()) ++tally.boundary_edges;
    if (!edge.manifold()) ++tally.non_manifold_edges;
  });
  return tallies;
}

std::vector<std::uint8_t> kept(std::span<const ComponentTally> tallies, const Measure& measure,
                               const ComponentFilter& filter) {
  if (!(filter.min_area >= 0) || !std::isfinite(filter.min_area)) {
    throw Error(ErrorCode::kUsage, fmt::format("no component has an area of {}", filter.min_area),
                "give the least area of a component to keep, 0 or more");
  }
  std::vector<std::uint32_t> order(tallies.size());
  std::iota(order.begin(), order.end(), std::uint32_t{0});
  std::sort(order.begin(), order.end(), [&](std::uint32_t left, std::uint32_t right) {
    const ComponentTally &a = tallies[left], &b = tallies[right];
    if (a.area.value() != b.area.value()) return a.area.value() > b.area.value();
    if (a.triangles != b.triangles) return a.triangles > b.triangles;
    return a.first < b.first;
  });
  const std::size_t most =
      filter.largest == 0 ? order.size() : std::min<std::size_t>(order.size(), filter.largest);
  std::vector<std::uint8_t> result(tallies.size(), 0);
  for (std::size_t n = 0; n < most; ++n) {
    result[order[n]] = measure.area_of(tallies[order[n]].area) >= filter.min_area ? 1 : 0;
  }
  return result;
}

Surface keep(const Surface& surface, const Components& components, std::span<const std::uint8_t> kept) {
  require(components.of_vertex.size() == surface.positions.size() && kept.size() == components.count,
          "components of this surface");
  constexpr std::uint32_t kGone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(surface.positions.size(), kGone), vertices, triangles;
  for (std::uint32_t n = 0; n < number.size(); ++n) {
    if (kept[components.of_vertex[n]] == 0) continue;
    number[n] = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back(n);
  }
  Surface part;
  part.cells = surface.cells;
  part.positions = picked(surface.positions, vertices);
  if (!surface.normals.empty()) part.normals = picked(surface.normals, vertices);
  if (!surface.keys.empty()) part.keys = picked(surface.keys, vertices);

  std::uint64_t count = 0;
  for (const Triangle& t : surface.triangles.all()) count += number[t[0]] == kGone ? 0 : 1;
  part.triangles.resize_uninitialised(count);
  part.row_first.reserve(surface.row_first.size());
  std::uint64_t next = 0;
  std::size_t row = 0;
  for (std::uint64_t n = 0; n <= surface.triangles.size(); ++n) {
    for (; row < surface.row_first.size() && surface.row_first[row] == n; ++row)
      part.row_first.push_back(next);
    if (n == surface.triangles.size()) break;
    const Triangle& t = surface.triangles[n];
    if (number[t[0]] != kGone) part.triangles[next++] = {number[t[0]], number[t[1]], number[t[2]]};
  }
  return part;
}

}  // namespace footwall::isosurface
