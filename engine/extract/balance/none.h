// No balancing: a face's centroid rank is responsible for it.
#pragma once
#include <vector>

#include "engine/extract/balance/balance.h"

namespace footwall::extract {

// Mean of the vertices, each component rounded to the nearest integer (ties to even), clamped into the
// survey.
survey::Index centroid_voxel(const survey::LatticeTriangle& triangle, const survey::Index& dims);

std::vector<int> balance_none(const BalanceInput& input);
void check_none(const Choice& choice);

}  // namespace footwall::extract
