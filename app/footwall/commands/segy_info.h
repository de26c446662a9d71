// `footwall info FILE.sgy`: what the headers of a SEG-Y file say, and whether they agree.
#pragma once
#include <string>

#include "app/footwall/console/program.h"

namespace footwall::commands {

console::Output segy_info(const std::string& file, const console::Console& console);

}  // namespace footwall::commands
