// SEG-Y in: one pass over the trace headers makes the survey's geometry and an index, then blocks of samples
// are pulled through the index, so that any trace order works and memory stays bounded: 16 bytes a trace +
// buffers. Based on: SEG Technical Standards, SEG-Y revisions 0, 1, 2.0 and 2.1; differs where
// real files differ (byte order of old revisions, header words that contradict each other,
// gaps, doubled traces).
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "storage/base/job_context.h"
#include "storage/survey/geometry.h"

namespace footwall::formats::segy {

enum class Endian : std::uint8_t { kBig, kLittle };
std::string_view name_of(Endian endian);  // "big", "little"

// Byte numbers are those of the standard, from 1; revision 1's are taken where nothing is given.
struct Options {
  std::optional<int> inline_byte;     // int32, default 189
  std::optional<int> crossline_byte;  // int32, default 193
  std::optional<int> x_byte;          // int32 times the scalar at 71, default 181
  std::optional<int> y_byte;          // default 185
  std::optional<int> format;          // the sample format code, where the file's is wrong
  std::optional<Endian> endian;
  // In the vertical unit; the default is the header's number divided by 1000: microseconds to milliseconds,
  // and by custom millimetres to metres, or thousandths of a foot to feet, in depth.
  std::optional<double> interval;
  // SEG-Y cannot tell the domain: the caller asks its user for both and refuses to go on without them.
  survey::Domain domain = survey::Domain::kTime;
  survey::VerticalUnit vertical_unit = survey::VerticalUnit::kMillisecond;
  std::string crs;
};

// What `info FILE.sgy` prints.
struct Report {
  int format = 0;
  std::string format_name;  // e.g. "IBM float32"
  Endian endian = Endian::kBig;
  int revision_major = 0;
  int revision_minor = 0;
  bool text_is_ebcdic = false;
  std::vector<std::string> text_header;           // 40 lines, UTF-8, trailing blanks removed
  std::vector<std::string> extended_text_header;  // all stanzas, one line each 80 columns
  std::int64_t traces = 0;                        // whole traces in the file
  std::int64_t samples = 0;                       // per trace
  double interval_us = 0;                         // as the header says it; 0 where it says nothing usable
  std::int64_t live_traces = 0;                   // bins of the survey that have a live trace
  std::int64_t dead_traces = 0;                   // trace identification 2
  std::int64_t duplicates = 0;                    // traces left out because an earlier one has the same lines
  std::int64_t missing_bins = 0;                  // bins of the survey without a live trace
  std::int64_t without_coordinates = 0;  // live traces whose X and Y are both zero, left out of the fit
  // Root mean square distance, in X/Y units, of the traces from the fitted map; NaN where no map was fitted.
  double residual = 0;
  bool right_handed = false;  // inline, crossline and down form a right-handed system in east, north, down
  std::vector<std::string> warnings;
};

// True if the file has a plausible SEG-Y binary header and room for a trace; never throws for its content.
bool looks_like_segy(const std::filesystem::path& path);

class SegyFile {
 public:
  // The header pass. Throws kNotFound, kIo; kFormat where the headers make no sense; kUnsupported for format
  // 4, unknown codes and prestack files; kInvalid for line numbers that make no grid; kUsage for byte
  // positions outside the header; kCancelled. Cancelled every few thousand traces.
  static SegyFile scan(const std::filesystem::path& path, const Options& options, const JobContext& job = {});

  SegyFile(SegyFile&&) noexcept;
  SegyFile& operator=(SegyFile&&) noexcept;
  ~SegyFile();

  const survey::Geometry& geometry() const;
  const Report& report() const;

  // values: box.count() floats, [inline][crossline][sample]; NaN where there is no live trace.
  // live: one byte for each trace of the box, [inline][crossline], 1 = live.
  // May be called from several threads at once. Throws kInternal for a box outside the survey or spans of
  // another size, kIo, kCorrupt if the file has shrunk since the scan.
  void read_block(const survey::Box& box, std::span<float> values, std::span<std::uint8_t> live) const;

  // Samples read so far that do not fit into a float32 and became +-FLT_MAX; counted at each reading.
  std::int64_t overflowed() const;

 private:
  struct State;
  explicit SegyFile(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace footwall::formats::segy
