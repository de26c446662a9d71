// A batch job on disk: JOB.json and, beside it, the faces in one checked binary file. No MPI here: the
// command line writes jobs, ranks read them.
//
// JOB.json, version 1 (paths are relative to the folder of JOB.json, or absolute):
//   footwall_job  1
//   volume        {path, checksum}: 16 hex digits, or "" for "do not check"
//   geometry      {inlines{first, step, count}, crosslines{first, step, count}, samples, z0, interval,
//                  domain "time"|"depth", vertical_unit "ms"|"m"|"ft", horizontal_unit "m"|"ft", crs,
//                  map{origin_x, origin_y, per_inline_x, per_inline_y, per_crossline_x, per_crossline_y}}:
//                  the volume's own, checked; faces stand in its index space, also where the volume covers
//                  only a part of the survey
//   faces         {path, count, hash}: faces in the order of `faults`, see faces_file.h; hash of that file
//   faults        [{id, name, faces}]: faces = how many
//   options       {exchange, balance, voxelizer, threads, compute[], velocity}: m/s or null
//   output        folder for part files and result.json; made if it is not there
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/extract/face.h"
#include "storage/survey/geometry.h"

namespace footwall::session {

struct JobFault {
  std::int64_t id = 0;
  std::string name;
  std::vector<extract::Face> faces;  // all with fault == id
};

struct Job {
  std::filesystem::path volume;  // absolute after read_job
  std::string volume_checksum;
  survey::Geometry geometry;
  std::vector<JobFault> faults;
  extract::Options options;
  std::optional<double> velocity;  // m/s
  std::filesystem::path output;    // absolute after read_job
};

// Writes JOB.json and the faces beside it (JOB.faces for JOB.json), each whole or not at all, the faces
// first. Throws kIo, kInvalid (a face that is not of its fault).
void write_job(const Job& job, const std::filesystem::path& path);
// Throws kNotFound, kFormat (what is wrong and where), kCorrupt (the faces' hash), kUnsupported (a newer
// version).
Job read_job(const std::filesystem::path& path);

// The two files of a job as bytes, so that one rank reads them for all.
struct JobFiles {
  std::string json;
  std::string faces;
};
JobFiles read_job_files(const std::filesystem::path& path);
// `folder` is that of JOB.json.
Job parse_job(const JobFiles& files, const std::filesystem::path& folder);
// Only the output folder that JOB.json names, absolute.
std::filesystem::path output_of(const std::filesystem::path& job_path);

// What decides the numbers of a fault's part: volume_checksum, geometry, statistics, velocity, and its faces;
// not ranks, threads, exchange, balance or paths.
std::uint64_t part_hash(const Job& job, const JobFault& fault);

}  // namespace footwall::session
