#include "storage/formats/segy/trace_header.h"

#include <fmt/format.h>

#include "storage/base/error.h"
#include "storage/formats/detail/bytes.h"

namespace footwall::formats::segy {
namespace {

int checked(const std::optional<int>& given, int standard, std::string_view what) {
  const int byte = given.value_or(standard);
  if (byte < 1 || byte > static_cast<int>(kTraceHeaderBytes) - 3) {
    throw Error(ErrorCode::kUsage, fmt::format("the {} cannot be at byte {}", what, byte),
                "trace header words of 4 bytes start at bytes 1 to 237");
  }
  return byte;
}

}  // namespace

HeaderBytes header_bytes(const Options& options) {
  const HeaderBytes standard;
  return {checked(options.inline_byte, standard.inline_number, "inline number"),
          checked(options.crossline_byte, standard.crossline_number, "crossline number"),
          checked(options.x_byte, standard.x, "X coordinate"),
          checked(options.y_byte, standard.y, "Y coordinate")};
}

double scaled(double value, int scalar) {
  if (scalar > 0) return value * scalar;
  // Dividing, not multiplying by a reciprocal, gives the double nearest to the decimal number that was meant.
  if (scalar < 0) return value / -static_cast<double>(scalar);
  return value;
}

TraceHeader read_trace_header(std::span<const std::byte, kTraceHeaderBytes> header, const HeaderBytes& at,
                              bool swap) {
  const auto word = [&](int byte) { return detail::load<std::int32_t>(header.data() + byte - 1, swap); };
  const auto half = [&](int byte) { return detail::load<std::int16_t>(header.data() + byte - 1, swap); };
  TraceHeader read;
  read.inline_number = word(at.inline_number);
  read.crossline_number = word(at.crossline_number);
  const int scalar = half(71);
  read.x = scaled(word(at.x), scalar);
  read.y = scaled(word(at.y), scalar);
  read.offset = word(37);
  read.dead = half(29) == 2;
  read.coordinate_unit = half(89);
  read.delay_ms = scaled(half(109), half(215));
  read.samples = static_cast<std::uint16_t>(half(115));
  read.interval_us = half(117);
  return read;
}

}  // namespace footwall::formats::segy
