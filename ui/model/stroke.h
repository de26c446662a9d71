// A free-hand stroke to the few nodes that it needs.
#pragma once
#include <span>
#include <vector>

#include "storage/survey/points.h"

namespace footwall::ui {

// Index space; no point of the stroke lies further than `tolerance` voxels from the line through the nodes.
// First and last point stay; points that stand on each other count once. Based on: Douglas and Peucker,
// reduction of the number of points required to represent a digitized line, 1973.
std::vector<survey::IndexPoint> simplified(std::span<const survey::IndexPoint> stroke, double tolerance);

// Where a new point belongs in a polyline: 0 before the first, size() behind the last; so that the line gets
// least longer.
std::size_t best_place(std::span<const survey::IndexPoint> line, const survey::IndexPoint& point);

}  // namespace footwall::ui
