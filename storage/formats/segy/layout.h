// What the binary header and the file's size say together: where the traces are and how they are coded.
#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>

#include "storage/formats/detail/read_only_file.h"
#include "storage/formats/segy/layout_stanza.h"
#include "storage/formats/segy/samples.h"
#include "storage/formats/segy/segy_file.h"
#include "storage/formats/segy/trace_header.h"

namespace footwall::formats::segy {

struct Layout {
  Endian endian = Endian::kBig;
  bool swap = true;  // bytes have to be swapped on this machine
  const SampleFormat* format = nullptr;
  std::int64_t samples = 0;            // per trace
  std::int64_t first_trace = 0;        // file offset of the first trace
  std::int64_t trace_header_size = 0;  // 240, more with revision 2's additional headers
  std::int64_t trace_size = 0;         // header and samples
  std::int64_t traces = 0;             // whole ones
  double interval_us = 0;              // of the binary header; 0 where unusable
  int measurement = 0;                 // 1 metres, 2 feet, else not said
  bool has_extension = false;          // the additional header SEG00001, with coordinates in double
  std::optional<LayoutStanza> stanza;  // where the file itself says what stands where

  // What of a trace header is read: the standard's and the first additional one.
  std::int64_t header_bytes() const { return std::min<std::int64_t>(trace_header_size, kMostHeaderBytes); }
  std::int64_t offset_of(std::int64_t trace) const { return first_trace + trace * trace_size; }
};

// Fills the report's format, revision, text headers and counts as far as it comes and adds warnings. Throws
// kFormat, kUnsupported.
Layout read_layout(const detail::ReadOnlyFile& file, const Options& options, Report& report);

}  // namespace footwall::formats::segy
