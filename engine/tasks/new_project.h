// Makes a project, with a first volume where asked; a failure or cancel leaves no file behind.
#pragma once
#include <filesystem>
#include <string>

#include "engine/tasks/volume_sources.h"

namespace footwall::tasks {

// Without a survey: surfaces then keep the coordinates of their files.
void new_empty_project(const std::filesystem::path& path);
project::VolumeRecord new_project(const std::filesystem::path& path, const std::string& volume_name,
                                  const VolumeSource& source, const JobContext& job);
// With its picked pillars as faults and its true surfaces. signal_to_noise, jitter: see synthetic::Options.
project::VolumeRecord new_synthetic_project(const std::filesystem::path& path, const std::string& kind,
                                            const survey::Index& size, std::uint64_t seed,
                                            double signal_to_noise, const JobContext& job);

}  // namespace footwall::tasks
