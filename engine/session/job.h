// A batch job on disk: JOB.json and, beside it, the faces in one checked binary file. No MPI here: the
// command line writes jobs, ranks read them.
//
// JOB.json, version 1 (paths are relative to the folder of JOB.json, or absolute):
//   footwall_job  1
//   volume        {path, checksum, name, origin[3]}: checksum of 16 hex digits, or "" for "do not check";
//   name
//                 in the project and its first voxel in the survey's index space, for `attach`
//   geometry      of the volume, see survey/geometry_json.h; checked; faces stand in its index space, also
//                 where the volume covers only a part of the survey
//   faces         {path, count, hash}: faces in the order of `faults`, see faces_file.h; hash of that file
//   faults        [{id, name, revision, faces}]: faces = how many; revision of the mesh that they are of
//   options       {exchange, balance, voxelizer, threads, compute[], velocity}: velocity in m/s or null; may
//   be
//                 left out: snr in dB or 0, lot_order, filter, pillars [a, b] of a rank along inlines and
//                 crosslines, and cache, bytes of other ranks' voxels that a rank keeps
//   output        folder for part files and result.json; made if it is not there
//   run           what the run is to be called in the project; "" = as usual
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
  std::int64_t revision = 0;         // of the mesh, see project::MeshRecord
};

struct Job {
  std::filesystem::path volume;  // absolute after read_job
  std::string volume_checksum;
  std::string volume_name;               // in the project
  survey::Index volume_origin{0, 0, 0};  // of its first voxel in the survey
  survey::Geometry geometry;
  std::vector<JobFault> faults;
  extract::Options options;
  std::optional<double> velocity;  // m/s
  std::filesystem::path output;    // absolute after read_job
  std::string run;                 // name of the run
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

// What decides the numbers of a fault's part: volume_checksum, geometry (without its words: crs, assumed),
// statistics, velocity, how voxels are coded, and its faces; not ranks, threads, exchange, balance, pillars,
// cache, names or paths.
std::uint64_t part_hash(const Job& job, const JobFault& fault);
// Of the parts of all faults, in their order: the same for jobs that give the same numbers.
std::uint64_t job_hash(const Job& job);

}  // namespace footwall::session
