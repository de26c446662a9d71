#include "engine/isosurface/properties.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/isosurface/edges.h"

namespace footwall::isosurface {
namespace {

double component_of(const Point& p, int axis) {
  return axis == 0 ? p.i : axis == 1 ? p.j : p.k;
}

bool is_null_cell(const Field& field, const survey::Index& cell) {
  for (int corner = 0; corner < 8; ++corner) {
    std::int64_t at = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const std::int64_t index = cell[axis] - field.origin[axis] + (corner >> axis & 1);
      if (index < 0 || index >= field.size[axis]) return false;  // not ours to tell
      at = at * field.size[axis] + index;
    }
    if (std::isnan(field.values[static_cast<std::size_t>(at)])) return true;
  }
  return false;
}

void count_boundary_edge(const Surface& surface, const Field* field, const Edge& edge,
                         BoundaryEdges& counts) {
  const Point &p = surface.positions[edge.a], &q = surface.positions[edge.b];
  for (int axis = 0; axis < 3; ++axis) {
    const double at = component_of(p, axis);
    if (at != component_of(q, axis) || at != std::floor(at)) continue;
    const auto sample = static_cast<std::int64_t>(at);
    if (sample == surface.cells.lo[axis] || sample == surface.cells.hi[axis]) {
      ++counts.at_border;
      return;
    }
    // The edge lies in the face between two cells.
    survey::Index cell;
    for (int other = 0; other < 3; ++other) {
      cell[other] =
          static_cast<std::int64_t>(std::floor((component_of(p, other) + component_of(q, other)) / 2));
    }
    survey::Index before = cell;
    before[axis] = sample - 1;
    if (field != nullptr && (is_null_cell(*field, cell) || is_null_cell(*field, before))) {
      ++counts.at_nulls;
      return;
    }
  }
  ++counts.inside;
}

}  // namespace

BoundaryEdges boundary_edges_of(const Surface& surface, const Field* field) {
  BoundaryEdges counts;
  for_each_edge(surface, [&](const Edge& edge) {
    if (edge.boundary()) count_boundary_edge(surface, field, edge, counts);
  });
  return counts;
}

Properties summary_of(std::vector<ComponentTally> components, const BoundaryEdges& boundary_edges,
                      const Measure& measure) {
  Properties all;
  all.boundary_edges = boundary_edges;
  ExactSum area, volume;
  bool closed = true;
  for (const ComponentTally& each : components) {
    all.vertices += each.vertices;
    all.edges += each.edges;
    all.triangles += each.triangles;
    all.non_manifold_edges += each.non_manifold_edges;
    all.euler += each.euler();
    all.genus += each.genus();
    all.closed_components += each.closed() ? 1 : 0;
    area.merge(each.area);
    volume.merge(each.volume);
    closed = closed && each.closed();
  }
  all.area = measure.area_of(area);
  if (closed) all.volume = measure.volume_of(volume);
  all.components = std::move(components);
  return all;
}

Properties properties_of(const Surface& surface, const Measure& measure, const Field* field) {
  return summary_of(tallies_of(surface, components_of(surface), measure), boundary_edges_of(surface, field),
                    measure);
}

}  // namespace footwall::isosurface
