// The kinds of volume that can be brought in, each as something that fills blocks.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/tasks/add_volume.h"
#include "storage/formats/nrrd.h"
#include "storage/formats/segy/segy_file.h"

namespace footwall::synthetic {
class FaultedSurvey;
}

namespace footwall::tasks {

struct SegyImport {
  VolumeSource source;
  formats::segy::Report report;
};
// Scans the headers (the first part of the job).
SegyImport segy_source(const std::filesystem::path& path, const formats::segy::Options& options,
                       const JobContext& job);

// What the user has to tell about a raw file that no survey describes.
struct RawOptions {
  survey::Index dims{0, 0, 0};  // inlines, crosslines, samples
  std::string axes = "ijk";     // slowest to fastest, see formats::raw
  bool big_endian = false;
  std::optional<float> null_value;
};
// Geometry: `survey`'s where given (dims must be the same), else `assumed` with lines from 1 and bins of one
// unit.
VolumeSource raw_source(const std::filesystem::path& path, const RawOptions& options,
                        const survey::Geometry& geometry);
// A geometry for a file that has none: lines from 1, one horizontal unit a bin; says so in `assumed`.
survey::Geometry plain_geometry(const survey::Index& dims, survey::Domain domain, survey::VerticalUnit unit,
                                double interval);

struct NrrdOptions {
  std::string axes;  // slowest to fastest; empty: formats::nrrd::default_order
  formats::nrrd::Meaning meaning;
  std::optional<float> null_value;
};
// A file that does not say where it lies takes the place of `survey`, where there is one: its dims must be
// the survey's, and an interval that it states too. scratch: the folder for unpacking (the first part of the
// job).
VolumeSource nrrd_source(const std::filesystem::path& path, const NrrdOptions& options,
                         const std::optional<survey::Geometry>& survey, const std::filesystem::path& scratch,
                         const JobContext& job);

// The made survey must outlive the source.
VolumeSource synthetic_source(const synthetic::FaultedSurvey& made, const std::string& name);

}  // namespace footwall::tasks
