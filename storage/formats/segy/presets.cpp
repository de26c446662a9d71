#include "storage/formats/segy/presets.h"

#include <fmt/format.h>

#include <array>
#include <string>

#include "storage/base/error.h"

namespace footwall::formats::segy {
namespace {

constexpr HeaderWord kFloatX{81, WordType::kIeee}, kFloatY{85, WordType::kIeee};

constexpr std::array kPresets{
    Preset{"rev1", "the standard since revision 1", 189, 193, 181, 185},
    Preset{"standard_3d", "lines where the standard has coordinates, and the reverse", 181, 185, 189, 193},
    Preset{"petrel_3d", "Petrel's older habit: trace sequence and ensemble numbers", 5, 21, 73, 77},
    Preset{"teapot", "Teapot Dome: lines at 181 and 185, receiver coordinates", 181, 185, 81, 85},
    Preset{"field_record", "field record and ensemble numbers", 9, 21, 181, 185},
    Preset{"float_xy", "field record and channel numbers, IEEE float coordinates", 9, 13, kFloatX, kFloatY},
    Preset{"unassigned", "lines in the unassigned bytes", 213, 217, 181, 185},
    Preset{"swapped", "inline and crossline numbers exchanged", 193, 189, 181, 185},
    Preset{"line_2d", "a 2-D line by its ensemble numbers", kNoWord, 21, 181, 185},
};

}  // namespace

std::span<const Preset> presets() {
  return kPresets;
}

const Preset& preset_named(std::string_view name) {
  std::string names;
  for (const Preset& preset : kPresets) {
    if (preset.name == name) return preset;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", preset.name);
  }
  throw Error(ErrorCode::kUsage, fmt::format("there is no preset '{}'", name), "presets are " + names);
}

}  // namespace footwall::formats::segy
