// The words of --camera.
#pragma once
#include <string>

#include "engine/render/fault_picture.h"

namespace footwall::tasks {

// "azimuth,elevation[,zoom]" in degrees, or "x,y,z;x,y,z[;x,y,z]": eye, target and up in the scene frame
// (metres east, north and up from the survey's centre); `into` keeps the rest. Throws Error kUsage for
// numbers that make no sense, kNotFound for a word: projects keep no views yet.
void take_camera(const std::string& words, render::View& into);

}  // namespace footwall::tasks
