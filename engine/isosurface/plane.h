// Two planes of samples at a time: each intersection and each gradient is computed once, and no more than two
// planes of what is derived from the samples are kept.
// Based on: seed 000, section 3 (calc_xy, calc_z, march); differs in that planes are those of constant inline
// (the paper's Z axis is our slowest one), that the interior of a cell is decided, too, and that
// intersections are numbered row by row, so that the order is that of Surface without sorting.
#pragma once
#include "engine/isosurface/case_tables.h"
#include "engine/isosurface/extract.h"

namespace footwall::isosurface {

// One thread; options.threads is not used. Throws as extract(), and kUnsupported for options.bricks: this
// variant reads every sample.
void extract_plane(const Field& field, float isovalue, const ExtractOptions& options, Surface& into);
void extract_plane(const Field& field, float isovalue, const ExtractOptions& options, const CaseRules& rules,
                   Surface& into);

}  // namespace footwall::isosurface
