// `footwall info FILE.sgy`: what the headers of a SEG-Y file say, and whether they agree: the report to read
// before an import.
#pragma once
#include <string>

#include "app/footwall/commands/segy_options.h"
#include "app/footwall/console/program.h"

namespace footwall::commands {

// Also of a file that import would refuse: `importable` is false then, and `reason` says why.
console::Output segy_info(const std::string& file, const SegyOptions& options,
                          const console::Console& console);

}  // namespace footwall::commands
