// A job over a small random volume, for the tests of this folder.
#pragma once
#include <filesystem>
#include <random>

#include "engine/session/job.h"
#include "scratch_folder.h"
#include "storage/base/hash.h"
#include "storage/volume/volume_writer.h"

namespace footwall::session {

inline constexpr survey::Index kSmallDims{20, 14, 30};

inline float small_value(const survey::Index& p) {
  std::mt19937 random(static_cast<unsigned>(1 + (p[0] * kSmallDims[1] + p[1]) * kSmallDims[2] + p[2]));
  const auto whole = static_cast<int>(random() % 20001) - 10000;
  return whole % 37 == 0 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(whole) * 0.125F;
}

inline survey::Geometry small_geometry() {
  survey::Geometry geometry;
  geometry.inlines = {100, 2, kSmallDims[0]};
  geometry.crosslines = {500, 1, kSmallDims[1]};
  geometry.samples = kSmallDims[2];
  geometry.interval = 4;
  geometry.map = {1000, 2000, 0, 25, 25, 0};
  return geometry;
}

inline std::vector<extract::Face> small_faces(std::int64_t fault, int count) {
  std::mt19937 random(static_cast<unsigned>(fault));
  std::vector<extract::Face> faces;
  for (int n = 0; n < count; ++n) {
    extract::Face face{fault, 3, n, {}};
    for (survey::LatticePoint& p : face.triangle) {
      p = {static_cast<std::int32_t>(random() % (22 * 256)) - 256,
           static_cast<std::int32_t>(random() % (16 * 256)) - 256,
           static_cast<std::int32_t>(random() % (32 * 256)) - 256};
    }
    faces.push_back(face);
  }
  return faces;
}

// Writes the volume and JOB.json into `folder`; returns the job as written. No communication.
inline Job write_small_job(const std::filesystem::path& folder) {
  volume::WriteOptions options;
  options.geometry = small_geometry();
  options.chunk = survey::Index{8, 8, 8};
  const auto info =
      volume::write_volume(folder / "volume.h5", options,
                           [](const survey::Box& box, std::span<float> values, std::span<std::uint8_t>) {
                             std::size_t n = 0;
                             for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
                               for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
                                 for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k)
                                   values[n++] = small_value({i, j, k});
                               }
                             }
                           },
                           {});
  Job job;
  job.volume = "volume.h5";
  job.volume_checksum = to_hex(info.checksum);
  job.geometry = small_geometry();
  job.faults = {{1, "Big fault", small_faces(1, 40)}, {2, "Klüft 2", small_faces(2, 9)}, {5, "empty", {}}};
  job.output = "out";
  write_job(job, folder / "JOB.json");
  return job;
}

}  // namespace footwall::session
