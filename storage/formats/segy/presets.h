// Where programs and archives put line numbers and coordinates: the names of `--preset`.
#pragma once
#include <span>
#include <string_view>

#include "storage/formats/segy/header_word.h"

namespace footwall::formats::segy {

struct Preset {
  std::string_view name;
  std::string_view help;
  HeaderWord inline_word, crossline_word, x, y;
};

// The most common first.
std::span<const Preset> presets();
// Throws kUsage, naming all of them, for a name that is none.
const Preset& preset_named(std::string_view name);

}  // namespace footwall::formats::segy
