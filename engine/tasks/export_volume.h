// A volume in other programs' formats. volume: its name, empty for the first.
#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "storage/base/job_context.h"
#include "storage/formats/raw.h"
#include "storage/formats/segy/segy_writer.h"
#include "storage/project/project.h"

namespace footwall::tasks {

// float32 samples; nulls as NaN, or as the volume's own null value where it has one. Returns the number of
// samples.
std::int64_t export_raw(const project::Project& project, const std::string& volume,
                        const std::filesystem::path& file, const formats::raw::WriteOptions& options,
                        const JobContext& job);
// One plane of it, by the words of section_plane(): the two axes that are left, in their order; nulls as NaN.
struct RawSection {
  int axis = 0;                      // that is left out
  std::int64_t index = 0;            // in the survey
  std::array<std::int64_t, 2> dims;  // of the other two
};
// Throws kInvalid for a plane that the volume does not have, what export_raw and section_plane throw.
RawSection export_raw_section(const project::Project& project, const std::string& volume,
                              const std::string& words, const std::filesystem::path& file, bool big_endian,
                              const JobContext& job);
// See formats::nrrd::write; nulls as NaN.
void export_nrrd(const project::Project& project, const std::string& volume,
                 const std::filesystem::path& file, const formats::raw::AxisOrder& order,
                 const JobContext& job);
// See formats::vti::write; nulls as NaN, the array has the volume's name.
void export_vti(const project::Project& project, const std::string& volume, const std::filesystem::path& file,
                bool z_up, const JobContext& job);

struct SegyExport {
  int format = 5;
  formats::segy::Holes holes = formats::segy::Holes::kSkip;
  std::optional<float> null_value;
};
formats::segy::Written export_segy(const project::Project& project, const std::string& volume,
                                   const std::filesystem::path& file, const SegyExport& options,
                                   const JobContext& job);

}  // namespace footwall::tasks
