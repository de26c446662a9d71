// The data-parallel formulation: every step is a loop over contiguous arrays without branches, whether a
// surface passes or not, so that it runs on vector units.
// Based on: seed 002, section 3 (interpolation on all edges, one array per axis; boolean volume; the index as
// a vector expression; a table of 128 entries, the others by complementary symmetry, facets of variable
// length); differs in that the arrays hold one plane of the volume at a time, so that they stay in the cache,
// in that each entry has its face and interior alternatives, and in that the boolean is 1 at or above the
// isovalue.
#pragma once
#include "engine/isosurface/case_tables.h"
#include "engine/isosurface/extract.h"

namespace footwall::isosurface {

// One thread; options.threads is not used. Throws as extract(), and kUnsupported for options.bricks: this
// variant reads every sample.
void extract_vector(const Field& field, float isovalue, const ExtractOptions& options, Surface& into);
// With other rules, whose patterns are taken as they are.
void extract_vector(const Field& field, float isovalue, const ExtractOptions& options, const CaseRules& rules,
                    Surface& into);

}  // namespace footwall::isosurface
