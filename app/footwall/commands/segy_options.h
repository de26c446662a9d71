// How a SEG-Y file is to be read: the options that `info`, `import volume` and `new` have in common.
#pragma once
#include <optional>
#include <string>

#include "app/footwall/console/program.h"
#include "storage/formats/segy/segy_file.h"

namespace footwall::commands {

struct SegyOptions {
  std::optional<std::string> inline_byte, crossline_byte, x_byte, y_byte;
  std::optional<int> coordinate_scalar, format;
  std::optional<std::string> endian;
  std::string preset;

  void add_to(CLI::App& command);
  // Without domain, unit, CRS and interval, which are not SEG-Y's alone. Throws kUsage, naming the option.
  formats::segy::Options to_options() const;
};

}  // namespace footwall::commands
