// The connected components of a surface, what each of them is, and surfaces made of some of them.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/isosurface/measure.h"
#include "engine/isosurface/surface.h"

namespace footwall::isosurface {

// Two vertices are connected when an edge of a triangle joins them. Components are numbered by their first
// vertex in the surface's order, so that the numbers are the same for every thread count.
struct Components {
  std::vector<std::uint32_t> of_vertex;  // number of the component
  std::uint32_t count = 0;
};
Components components_of(const Surface& surface);

// What one component is made of. Tallies of parts of a component are joined by merge() once their vertices,
// edges and boundary edges count each once; sums are exact, so that the order does not matter.
struct ComponentTally {
  std::uint64_t vertices = 0;
  std::uint64_t edges = 0;
  std::uint64_t triangles = 0;
  std::uint64_t boundary_edges = 0;      // with one triangle
  std::uint64_t non_manifold_edges = 0;  // with three or more, or with two that run the same way
  ExactSum area;                         // see Measure
  ExactSum volume;
  Point lo{0, 0, 0},
      hi{0, 0, 0};      // bounding box of the vertices, index space; of nothing where vertices is 0
  VertexKey first = 0;  // the smallest key, or the first vertex's number where there are no keys

  bool closed() const { return boundary_edges == 0 && non_manifold_edges == 0; }
  std::int64_t euler() const {
    return static_cast<std::int64_t>(vertices) - static_cast<std::int64_t>(edges) +
           static_cast<std::int64_t>(triangles);
  }
  // Handles of a closed component: (2 - Euler) / 2. Of an open one not defined, 0.
  std::int64_t genus() const { return closed() ? (2 - euler()) / 2 : 0; }
  void merge(const ComponentTally& other);
};
// One for each component, in the order of their numbers.
std::vector<ComponentTally> tallies_of(const Surface& surface, const Components& components,
                                       const Measure& measure);

// Which components to keep.
struct ComponentFilter {
  std::uint64_t largest = 0;  // this many of the largest by area; 0: all
  double min_area = 0;        // in the measure's units; smaller ones go
  bool keeps_all() const { return largest == 0 && min_area <= 0; }
};
// One entry for each tally, not zero where it is kept. Of components of equal area the one with more
// triangles is the larger, then the one whose `first` is smaller. Throws Error kUsage for an area below 0 or
// not finite.
std::vector<std::uint8_t> kept(std::span<const ComponentTally> tallies, const Measure& measure,
                               const ComponentFilter& filter);
// The triangles and vertices of the kept components, in the surface's order, with what it has of normals and
// keys; row_first counts what is left.
Surface keep(const Surface& surface, const Components& components, std::span<const std::uint8_t> kept);

}  // namespace footwall::isosurface
