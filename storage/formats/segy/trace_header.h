// The words of a trace header that a post-stack survey needs.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "storage/formats/segy/segy_file.h"

namespace footwall::formats::segy {

inline constexpr std::size_t kTraceHeaderBytes = 240;

// Where the words are, as byte numbers from 1.
struct HeaderBytes {
  int inline_number = 189;
  int crossline_number = 193;
  int x = 181;
  int y = 185;
};
// Throws kUsage for a position where no 4-byte word fits into the header.
HeaderBytes header_bytes(const Options& options);

struct TraceHeader {
  std::int32_t inline_number = 0;
  std::int32_t crossline_number = 0;
  double x = 0;  // scaled in double precision
  double y = 0;
  std::int32_t offset = 0;
  bool dead = false;
  int coordinate_unit = 0;  // 1 length, 2 seconds of arc, 3 degrees, 4 degrees minutes seconds, 0 not said
  double delay_ms = 0;
  int samples = 0;
  int interval_us = 0;
};
TraceHeader read_trace_header(std::span<const std::byte, kTraceHeaderBytes> header, const HeaderBytes& at,
                              bool swap);

// SEG-Y's scalars: 0 means 1, positive ones multiply, negative ones divide.
double scaled(double value, int scalar);

}  // namespace footwall::formats::segy
