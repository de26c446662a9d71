// Closes an open surface along the border of its volume.
#pragma once
#include "engine/isosurface/field.h"
#include "engine/isosurface/surface.h"

namespace footwall::isosurface {

// Vertices of a cap that stand on a sample of the border: this plus the sample's number (i * nj + j) * nk +
// k.
inline constexpr VertexKey kSampleKey = VertexKey{1} << 63;

// Adds, on the faces of the volume's box, what of them lies at or above the isovalue, so that surface and
// caps together bound the part of the volume that is at or above it. The caps share the surface's vertices on
// the border; where they meet a new vertex they stand on a sample, with the face's outward direction as
// normal (at the box's edges the mean of the faces'). Vertices and triangles are added at the end: row_first,
// if there, still counts the surface's own. An ambiguous square of a face is cut as its cell decides.
//
// `surface` must be extracted from `field` with this isovalue, all its cells, and keys. Only the faces that
// the field reaches are capped. Beside cells with null samples the surface stays open, and so does the cap.
// Throws Error kInvalid for a surface without keys or that does not fit the field, kUnsupported for 2^32
// vertices.
void cap(const Field& field, float isovalue, Surface& surface);

}  // namespace footwall::isosurface
