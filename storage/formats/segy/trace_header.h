// The words of a trace header that a post-stack survey needs.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "storage/formats/segy/segy_file.h"

namespace footwall::formats::segy {

inline constexpr std::size_t kTraceHeaderBytes = 240;

// Trace headers are read up to here: the standard's and the first additional one of revision 2.
inline constexpr std::size_t kMostHeaderBytes = 2 * kTraceHeaderBytes;

// Where the words are.
struct HeaderBytes {
  HeaderWord inline_number = 189;
  HeaderWord crossline_number = 193;
  HeaderWord x = 181;
  HeaderWord y = 185;
  HeaderWord offset = 37;
  std::optional<int> coordinate_scalar;  // instead of each trace's own
};
// Throws kUsage for a word that does not fit into a header of this many bytes.
void check_fits(const HeaderBytes& at, std::int64_t header_bytes);

struct TraceHeader {
  std::int32_t inline_number = 0;
  std::int32_t crossline_number = 0;
  double x = 0;  // scaled in double precision
  double y = 0;
  double offset = 0;
  int coordinate_scalar = 1;  // of the trace, as it stands in the header, but 1 for 0
  bool dead = false;
  int coordinate_unit = 0;  // 1 length, 2 seconds of arc, 3 degrees, 4 degrees minutes seconds, 0 not said
  double delay_ms = 0;
  int samples = 0;
  int interval_us = 0;
};
// header: 240 bytes, and as many more as the words in `at` need; trace: its place in the file, from 0. Line
// numbers that are no int32 become the nearest one, or the lowest where they are no number at all.
TraceHeader read_trace_header(std::span<const std::byte> header, const HeaderBytes& at, bool swap,
                              std::int64_t trace);

// SEG-Y's scalars: 0 means 1, positive ones multiply, negative ones divide.
double scaled(double value, int scalar);

}  // namespace footwall::formats::segy
