// VTK XML PolyData out for large surfaces: points as doubles, normals as float point data, appended raw.
#pragma once
#include <filesystem>

#include "storage/base/job_context.h"
#include "storage/formats/triangle_source.h"

namespace footwall::formats::vtp {

// Facts go into the field data, as in vtp.h. Numbers of vertices take 32 bits where they fit. Throws kIo (a
// full disk leaves no file), kCancelled, what the source throws.
void write_surface(const std::filesystem::path& path, const TriangleSource& source, const SurfaceFacts& facts,
                   const JobContext& job = {});

}  // namespace footwall::formats::vtp
