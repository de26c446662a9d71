// CGAL's own word on whether a mesh cuts itself; in a file of its own because it compiles slowly.
#pragma once
#include "engine/pillars/triangulate.h"

namespace footwall::pillars::testing {

// Positions rounded to the lattice, as the engine has them; faces that vanish by it are left out.
bool cuts_itself(const FaultMesh& mesh, bool on_lattice);

}  // namespace footwall::pillars::testing
