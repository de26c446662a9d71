// Components, areas, volumes and Euler numbers of a mesh that is spread over ranks. Every vertex, edge and
// triangle counts once, sums are exact, so that the numbers are those of the mesh in one piece.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/isosurface/components.h"
#include "engine/isosurface/parallel/weld.h"
#include "engine/isosurface/properties.h"

namespace footwall::isosurface {

struct MeshProperties {
  // By own vertex and guest: the number of its component in the whole mesh, components being numbered by
  // their first vertex.
  std::vector<std::uint32_t> component;
  std::uint32_t components = 0;
  // On rank 0 only; empty elsewhere.
  Properties properties;
};

// Local union-find, then the labels of shared vertices are joined on rank 0; edges whose both ends are shared
// are counted by the owner of one of them. Boundary edges that do not lie on a face of the volume are counted
// as inside, also beside nulls. Collective.
MeshProperties mesh_properties(comm::Communicator& world, const MeshPart& part, const Measure& measure);

// Those components that the filter keeps. Collective; throws kUsage as isosurface::kept().
MeshPart keep_components(comm::Communicator& world, const MeshPart& part, const MeshProperties& properties,
                         const Measure& measure, const ComponentFilter& filter);

}  // namespace footwall::isosurface
