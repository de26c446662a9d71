// VTK XML ImageData out: one Float32 point array, appended raw, UInt64 headers, little-endian; streams.
// The volume keeps its own axes (inlines, crosslines, samples) and is put into place by Origin, Spacing and
// Direction, which VTK reads from 9.0 on: world X and Y, z = -depth so that it stands upright. Readers that
// ignore Direction show it in index space. Inlines run fastest.
// Based on: the VTK XML file formats, as VTK's wiki and its own writer state them.
#pragma once
#include <filesystem>
#include <string>

#include "storage/base/job_context.h"
#include "storage/formats/raw.h"
#include "storage/survey/geometry.h"

namespace footwall::formats::vti {

struct Options {
  std::string name = "amplitude";  // of the point array
  bool z_up = true;                // false: z as the survey has it, positive down
};

// Field data: vertical_unit, horizontal_unit, z_positive, crs, domain, and first_and_step of inlines and
// crosslines. Nulls are NaN. Throws kIo (a full disk leaves no file), what read throws, kCancelled.
void write(const std::filesystem::path& path, const survey::Geometry& geometry, const raw::BoxReader& read,
           const Options& options, const JobContext& job = {});

}  // namespace footwall::formats::vti
