// Which parts of a brick, 2 x 2 x 2 cells each, may hold triangles: those whose samples lie on both sides of
// the isovalue.
#pragma once
#include "engine/isosurface/extract.h"

namespace footwall::isosurface {

// brick: its place among the bricks of the volume; the field holds the samples of its cells. A part with
// nulls may be told active that has no triangles, never the other way round.
BrickParts active_parts(const Field& field, const survey::Index& brick, float isovalue);
// Has the samples of a brick fetched that will be asked for soon.
void fetch_brick(const Field& field, const survey::Index& brick);

}  // namespace footwall::isosurface
