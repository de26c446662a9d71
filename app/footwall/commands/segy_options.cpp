#include "app/footwall/commands/segy_options.h"

#include <fmt/format.h>

#include "storage/base/error.h"
#include "storage/formats/segy/presets.h"

namespace footwall::commands {
namespace {

std::optional<formats::segy::HeaderWord> word(const std::optional<std::string>& text,
                                              std::string_view option) {
  if (!text) return std::nullopt;
  return formats::segy::header_word_from(*text, option);
}

std::string preset_help() {
  std::string help = "SEG-Y: where line numbers and coordinates are, as ";
  for (const formats::segy::Preset& preset : formats::segy::presets()) {
    help += fmt::format("{}{} ({} {}, {} {})", &preset == formats::segy::presets().data() ? "" : ", ",
                        preset.name, text_of(preset.inline_word), text_of(preset.crossline_word),
                        text_of(preset.x), text_of(preset.y));
  }
  return help;
}

}  // namespace

void SegyOptions::add_to(CLI::App& command) {
  command.add_option("--preset", preset, preset_help());
  command.add_option("--inline-byte", inline_byte,
                     "SEG-Y: trace header byte of the inline number (default 189); :int16, :ieee, :ibm or "
                     ":float64 after it where it is no int32; none, order");
  command.add_option("--crossline-byte", crossline_byte,
                     "SEG-Y: trace header byte of the crossline number (default 193)");
  command.add_option("--x-byte", x_byte, "SEG-Y: trace header byte of X (default 181), e.g. 81:ieee");
  command.add_option("--y-byte", y_byte, "SEG-Y: trace header byte of Y (default 185)");
  command.add_option("--coordinate-scalar", coordinate_scalar,
                     "SEG-Y: scalar of X and Y, where the one at byte 71 is wrong: -100 divides by 100");
  command.add_option("--format", format, "SEG-Y: sample format code, where the file's is wrong");
  command.add_option("--endian", endian, "SEG-Y, raw: byte order, big or little (default: told; raw little)")
      ->check(CLI::IsMember({"big", "little"}));
}

formats::segy::Options SegyOptions::to_options() const {
  formats::segy::Options options;
  options.preset = preset;
  options.inline_byte = word(inline_byte, "--inline-byte");
  options.crossline_byte = word(crossline_byte, "--crossline-byte");
  options.x_byte = word(x_byte, "--x-byte");
  options.y_byte = word(y_byte, "--y-byte");
  options.coordinate_scalar = coordinate_scalar;
  options.format = format;
  if (endian)
    options.endian = *endian == "big" ? formats::segy::Endian::kBig : formats::segy::Endian::kLittle;
  return options;
}

}  // namespace footwall::commands
