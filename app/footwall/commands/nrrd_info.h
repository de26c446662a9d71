// `footwall info FILE.nrrd`: what the header of an NRRD file says.
#pragma once
#include <string>

#include "app/footwall/console/program.h"

namespace footwall::commands {

console::Output nrrd_info(const std::string& file);

}  // namespace footwall::commands
