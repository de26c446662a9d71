// STL out: binary. A triangle is a facet of its own with a normal of its own; positions are floats, so that
// world coordinates of seven digits before the point lose those behind it: PLY and VTP keep them.
#pragma once
#include <filesystem>

#include "storage/base/job_context.h"
#include "storage/formats/triangle_source.h"

namespace footwall::formats::stl {

// Holds the positions while it writes. The facet's normal is that of the triangle, by its winding, 0 0 0
// where rounding to floats has left it no area. Throws kUnsupported for 2^32 triangles or more, kInternal for
// a triangle that names a vertex that is not there, kIo (a full disk leaves no file), kCancelled, what the
// source throws.
void write(const std::filesystem::path& path, const TriangleSource& source, const SurfaceFacts& facts,
           const JobContext& job = {});

}  // namespace footwall::formats::stl
