// An attribute volume of a project's volume, computed by the engine and listed in the project.
#pragma once
#include <string>

#include "engine/extract/discontinuity_volume.h"
#include "engine/session/launch.h"
#include "storage/base/job_context.h"
#include "storage/project/project.h"

namespace footwall::tasks {

struct AttributeOptions {
  std::string volume;  // empty: the first one
  std::string name;    // of the new volume; empty: "VOLUME discontinuity"
  extract::Window window;
  session::LaunchOptions launch;
};

struct MadeAttribute {
  project::VolumeRecord volume;
  std::string of;  // the name of the volume that it was made from
  int ranks = 0;
  double seconds = 0;  // of the engine
};

// Throws kInvalid (the name is taken), kNotFound (no such volume, or its file is not there), and the engine's
// own errors. A failure or cancel leaves neither file nor row.
MadeAttribute make_attribute(project::Project& project, const AttributeOptions& options,
                             const JobContext& job);

}  // namespace footwall::tasks
