// Does OpenGL work here? Nothing links it: the libraries are looked for while the program runs.
#pragma once
#include <string>

#include "engine/tasks/doctor/finding.h"

namespace footwall::tasks {

// A warning where it does not: the command line draws without it, the editor does not.
Finding check_opengl();

}  // namespace footwall::tasks
