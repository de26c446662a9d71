// A project's volume, opened for reading: the file that the project means, or an error.
#pragma once
#include "storage/project/project.h"
#include "storage/volume/volume_reader.h"

namespace footwall::tasks {

// Throws kNotFound where the file is not there, kInvalid where another volume lies in its place, and what
// VolumeReader throws.
volume::VolumeReader open_volume(const project::Project& project, const project::VolumeRecord& volume);

// The row of a volume (empty name: the first) whose file is where it should be. Throws kNotFound.
project::VolumeRecord present_volume(const project::Project& project, const std::string& name);

}  // namespace footwall::tasks
