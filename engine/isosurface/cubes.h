// The serial algorithm, one cell after the other, that vectorizing is measured against.
// Based on: seed 002, section 2; differs in the table (every case with its face and interior alternatives
// instead of 14 or 128), and in that normals are computed.
#pragma once
#include "engine/isosurface/case_tables.h"
#include "engine/isosurface/extract.h"

namespace footwall::isosurface {

// For each cell: eight comparisons, the case's pattern, and each vertex either computed or borrowed from the
// neighbour that already did. Vertices are found in the order of the cells and put into the order of Surface
// at the end. One thread; options.threads is not used. Throws as extract(), and kUnsupported for
// options.bricks: this variant reads every sample.
void extract_cubes(const Field& field, float isovalue, const ExtractOptions& options, Surface& into);
void extract_cubes(const Field& field, float isovalue, const ExtractOptions& options, const CaseRules& rules,
                   Surface& into);

}  // namespace footwall::isosurface
