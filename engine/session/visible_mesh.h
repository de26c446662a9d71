// What all ranks extracted of an isosurface as one mesh on rank 0: only what can be seen of a surface is
// small.
#pragma once
#include <span>

#include "engine/comm/communicator.h"
#include "engine/isosurface/parallel/weld.h"
#include "engine/render/lit_surface.h"

namespace footwall::session {

// surfaces: of this rank, in the volume's index space; their numbers are those of the triangles in the whole
// surface, and no number is there twice. Vertices with the same position and normal, bit for bit, become one;
// those that no triangle uses are left out. Triangles ascend by number, vertices come in the order in which
// triangles use them, and have their own numbers for keys: the mesh does not depend on who extracted what.
// Collective; throws on all ranks kUnsupported for 2^32 vertices or triangles, kMemory.
isosurface::MeshPart visible_mesh(comm::Communicator& world, const survey::Index& volume,
                                  std::span<const render::LitSurface> surfaces);

}  // namespace footwall::session
