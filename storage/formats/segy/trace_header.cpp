#include "storage/formats/segy/trace_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "storage/base/error.h"
#include "storage/formats/detail/bytes.h"

namespace footwall::formats::segy {
namespace {

void check(const HeaderWord& word, std::int64_t header_bytes, std::string_view what) {
  if (word.type == WordType::kNone || word.type == WordType::kOrder) return;
  const std::int64_t last = header_bytes + 1 - size_of(word.type);
  if (word.byte >= 1 && word.byte <= last) return;
  throw Error(
      ErrorCode::kUsage, fmt::format("the {} cannot be at byte {}", what, word.byte),
      fmt::format("trace header words of {} bytes start at bytes 1 to {} here", size_of(word.type), last));
}

std::int32_t line_number(double value) {
  constexpr double kLowest = std::numeric_limits<std::int32_t>::min();
  constexpr double kHighest = std::numeric_limits<std::int32_t>::max();
  if (!(value > kLowest)) return std::numeric_limits<std::int32_t>::min();
  return static_cast<std::int32_t>(std::min(std::nearbyint(value), kHighest));
}

double finite(double value) {
  return std::isfinite(value) ? value : 0;
}

}  // namespace

void check_fits(const HeaderBytes& at, std::int64_t header_bytes) {
  const std::int64_t bytes = std::min<std::int64_t>(header_bytes, kMostHeaderBytes);
  check(at.inline_number, bytes, "inline number");
  check(at.crossline_number, bytes, "crossline number");
  check(at.x, bytes, "X coordinate");
  check(at.y, bytes, "Y coordinate");
  check(at.offset, bytes, "offset");
}

double scaled(double value, int scalar) {
  if (scalar > 0) return value * scalar;
  // Dividing, not multiplying by a reciprocal, gives the double nearest to the decimal number that was meant.
  if (scalar < 0) return value / -static_cast<double>(scalar);
  return value;
}

TraceHeader read_trace_header(std::span<const std::byte> header, const HeaderBytes& at, bool swap,
                              std::int64_t trace) {
  const auto half = [&](int byte) { return detail::load<std::int16_t>(header.data() + byte - 1, swap); };
  const auto line = [&](const HeaderWord& word) {
    return word.type == WordType::kInt32  ? detail::load<std::int32_t>(header.data() + word.byte - 1, swap)
           : word.type == WordType::kNone ? 1
                                          : line_number(value_of(word, header, swap, trace));
  };
  TraceHeader read;
  read.inline_number = line(at.inline_number);
  read.crossline_number = line(at.crossline_number);
  const int own = half(71);
  read.coordinate_scalar = own == 0 ? 1 : own;
  const auto coordinate = [&](const HeaderWord& word) {
    const double value = finite(value_of(word, header, swap, trace));
    if (at.coordinate_scalar) return scaled(value, *at.coordinate_scalar);
    return is_scaled(word.type) ? scaled(value, own) : value;
  };
  read.x = coordinate(at.x);
  read.y = coordinate(at.y);
  read.offset = finite(value_of(at.offset, header, swap, trace));
  read.dead = half(29) == 2;
  read.coordinate_unit = half(89);
  read.delay_ms = scaled(half(109), half(215));
  read.samples = static_cast<std::uint16_t>(half(115));
  read.interval_us = half(117);
  return read;
}

}  // namespace footwall::formats::segy
