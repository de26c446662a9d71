// The slow, obvious isosurface: cell by cell, vertices found by their key, then sorted.
#pragma once
#include <string>

#include "engine/isosurface/extract.h"

namespace footwall::verify {

// As engine/isosurface/surface.h and extract.h define it, with keys and normals always; options.bricks and
// threads are not looked at. What a variant gives must be equal, bit for bit.
isosurface::Surface surface_by_definition(const isosurface::Field& field, float isovalue,
                                          const isosurface::ExtractOptions& options);

// What of the parts that `made` has differs from the definition's surface; empty if nothing does.
std::string difference(const isosurface::Surface& made, const isosurface::Surface& defined);

// What is wrong with a surface whatever it is of: a position or normal that is no number or not a unit
// vector, a triangle without area or with a vertex that is not there, a vertex of no triangle; empty if
// nothing is.
std::string unsoundness(const isosurface::Surface& surface);

}  // namespace footwall::verify
