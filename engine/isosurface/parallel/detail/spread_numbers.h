// The numbers of a part's vertices, guests included, once its runs are numbered.
#pragma once
#include "engine/isosurface/parallel/weld.h"

namespace footwall::isosurface::detail {

// Fills part.numbers from part.vertex_runs. Collective.
void spread_numbers(comm::Communicator& world, MeshPart& part);

}  // namespace footwall::isosurface::detail
