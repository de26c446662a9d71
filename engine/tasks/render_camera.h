// The words of --camera, and views under a name.
#pragma once
#include <string>

#include "engine/render/fault_picture.h"
#include "storage/project/project.h"

namespace footwall::tasks {

// The name of a view that the project keeps (its exaggeration is taken where `into` has none), or
// "azimuth,elevation[,zoom]" in degrees, or "x,y,z;x,y,z[;x,y,z]": eye, target and up in the scene frame
// (metres east, north and up from the survey's centre); `into` keeps the rest. Throws Error kUsage for
// numbers that make no sense, kNotFound for a name that no view has.
void take_camera(const project::Project& project, const std::string& words, render::View& into);

// The camera of a view in the words above. Throws kUsage for one whose direction is still to be chosen.
std::string camera_words(const render::View& view);

}  // namespace footwall::tasks
