// The surface of a fault without pillars, and the mesh made of it.
#pragma once
#include <string>
#include <vector>

#include "storage/project/project.h"

namespace footwall::tasks {

// The surface in the survey's units (as stored where there is no survey). Throws kInvalid where its z is a
// time and the survey's a depth, or the other way round.
survey::Surface surface_in_survey(const project::Project& project, const project::SurfaceRecord& record);

// The surface as a mesh can hold it: faces in the surface's order, turned where neighbours disagree, cut so
// that they are manifold; panels numbered from 1 by connected piece, vertices and faces numbered within
// theirs. `notes` tells what had to be turned and cut.
project::MeshRecord imported_mesh(survey::Surface surface, std::int64_t revision,
                                  std::vector<std::string>& notes);

// True for a mesh that imported_mesh() made: its faces are the surface's triangles, in their order.
bool is_imported(const project::MeshRecord& mesh);

}  // namespace footwall::tasks
