// Pillars as a survey has them, in world coordinates, to index space, where their geometry lives, and back.
#pragma once
#include <span>
#include <vector>

#include "engine/pillars/course.h"
#include "engine/pillars/triangulate.h"
#include "storage/survey/geometry.h"
#include "storage/survey/pillar.h"

namespace footwall::pillars {

// Each named by its id.
std::vector<PillarInput> inputs_of(const survey::Geometry& survey, std::span<const survey::Pillar> pillars);

// The places of the mesh's vertices, in their order. A vertex that is a picked node keeps its position as
// picked: mapping it to index space and back would round it. pillars: those that the mesh was made of, their
// nodes' ids each given once.
std::vector<survey::WorldPoint> world_vertices(const survey::Geometry& survey,
                                               std::span<const survey::Pillar> pillars,
                                               const FaultMesh& mesh);

}  // namespace footwall::pillars
