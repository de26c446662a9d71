// What a surface is: how large, how many pieces, how connected, and whether it is whole.
#pragma once
#include <optional>

#include "engine/isosurface/components.h"
#include "engine/isosurface/field.h"

namespace footwall::isosurface {

// Where a surface ends: edges with one triangle only.
struct BoundaryEdges {
  std::uint64_t inside = 0;     // inside the volume, between cells with values: cracks, there must be none
  std::uint64_t at_border = 0;  // on the volume's border, or that of the cells that were looked at
  std::uint64_t at_nulls = 0;   // beside a cell with a null sample; counted as inside where no field is given
};

struct Properties {
  std::uint64_t vertices = 0;
  std::uint64_t edges = 0;
  std::uint64_t triangles = 0;
  BoundaryEdges boundary_edges;
  std::uint64_t non_manifold_edges = 0;  // with three or more triangles, or with two that run the same way
  std::int64_t euler = 0;                // vertices - edges + triangles
  std::uint64_t closed_components = 0;
  std::int64_t genus = 0;        // of the closed components together
  double area = 0;               // in the measure's unit, squared
  std::optional<double> volume;  // enclosed, cubed; only where every component is closed. Of a body whose
                                 // values are at or above the isovalue positive, of a hollow negative.
  std::vector<ComponentTally> components;  // by the number of components_of()
};

// `field`: the samples that the surface was extracted from, to tell nulls from cracks.
Properties properties_of(const Surface& surface, const Measure& measure, const Field* field = nullptr);
// From the components' tallies, wherever they were counted.
Properties summary_of(std::vector<ComponentTally> components, const BoundaryEdges& boundary_edges,
                      const Measure& measure);

// Edges with one triangle, sorted by where they are.
BoundaryEdges boundary_edges_of(const Surface& surface, const Field* field = nullptr);

}  // namespace footwall::isosurface
