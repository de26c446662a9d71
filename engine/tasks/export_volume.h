// A volume's samples as a raw file.
#pragma once
#include <filesystem>
#include <string>

#include "storage/base/job_context.h"
#include "storage/project/project.h"

namespace footwall::tasks {

// float32 little-endian, [inline][crossline][sample]; nulls as NaN, or as the volume's own null value where
// it has one. Returns the number of samples. volume: empty for the first.
std::int64_t export_raw(const project::Project& project, const std::string& volume,
                        const std::filesystem::path& file, const JobContext& job);

}  // namespace footwall::tasks
