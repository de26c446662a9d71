// The default way to extract: bits for the samples' signs, exact numbers of everything before anything is
// written, no search for vertices.
// Based on: seeds 000 and 002, after Schroeder, Maynard and Geveci, Flying Edges, 2015 (passes over rows,
// exact output sizes); differs in that 64 cells are classified at once from bits, vertices are numbered by
// counting bits, and bricks that the isovalue cannot cross are skipped (docs/isosurface-kernel.md).
#pragma once
#include "engine/isosurface/extract.h"

namespace footwall::isosurface {

// As extract(), whose checks are taken as done.
void extract_bricks(const Field& field, float isovalue, const ExtractOptions& options, Surface& into);

}  // namespace footwall::isosurface
