// PLY out: binary, little-endian; positions as doubles, so that world coordinates keep their digits, normals
// as floats, faces of three uint32.
#pragma once
#include <filesystem>

#include "storage/base/job_context.h"
#include "storage/formats/triangle_source.h"

namespace footwall::formats::ply {

// Facts stand in comment lines. Throws kIo (a full disk leaves no file), kCancelled, what the source throws.
void write(const std::filesystem::path& path, const TriangleSource& source, const SurfaceFacts& facts,
           const JobContext& job = {});

}  // namespace footwall::formats::ply
