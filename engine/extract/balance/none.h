// No balancing: a face's centroid rank is responsible for it.
#pragma once
#include <span>
#include <vector>

#include "engine/comm/rank_grid.h"
#include "engine/extract/face.h"

namespace footwall::extract {

// Mean of the vertices, each component rounded to the nearest integer (ties to even), clamped into the
// survey.
survey::Index centroid_voxel(const survey::LatticeTriangle& triangle, const survey::Index& dims);

// The responsible rank of every face. No communication: every rank gets the same.
std::vector<int> balance_none(const comm::RankGrid& grid, std::span<const Face> faces);

}  // namespace footwall::extract
