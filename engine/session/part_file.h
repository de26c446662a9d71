// The results of one fault: an HDF5 file in the job's output folder, written under a temporary name and
// renamed when whole (storage/volume/column_file.h). Layout, version 3: attributes format = "footwall part",
// version, fault, name, part_hash (16 hex digits), whole (the statistics over the fault's distinct voxels as
// JSON, fault_summary.h), check (hash64 of the columns as 16 hex digits), whole_face (the names of the
// whole-face computations, comma separated, or "none"); one dataset of `faces` entries per column: owner
// int64, n int32, vertices int32 [faces][3][3] (lattice i, j, k), count int64, nulls int64, outside uint8,
// and float64 each of kFaceNumbers (engine/extract/face_numbers.h), area, area_voxels, dip, dip_azimuth,
// normal_i, normal_j, normal_k, metres_along_normal. NaN = undefined. Further, for each of whole_face in
// turn, `faces` entries of blob_ends int64: where the bytes of each face end in blobs uint8.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/extract/face.h"
#include "engine/extract/face_blobs.h"
#include "engine/extract/face_geometry.h"

namespace footwall::session {

struct Part {
  std::int64_t fault = 0;
  std::string name;
  std::uint64_t hash = 0;  // part_hash() of the job
  std::vector<extract::Face> faces;
  std::vector<extract::FaceStatistics> statistics;  // one per face
  std::vector<extract::FaceGeometry> geometry;      // one per face
  std::vector<extract::FaceBlobs> blobs;            // one per whole-face computation
  extract::FaceStatistics whole = {};               // of the fault, over its distinct voxels
};

// "fault-<id>.part.h5"
std::filesystem::path part_path(const std::filesystem::path& output, std::int64_t fault);
// Throws kIo.
void write_part(const Part& part, const std::filesystem::path& path);
// Throws kNotFound, kFormat, kCorrupt (the check differs).
Part read_part(const std::filesystem::path& path);

}  // namespace footwall::session
