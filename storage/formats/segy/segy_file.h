// SEG-Y in: one pass over the trace headers makes the survey's geometry and an index, then blocks of samples
// are pulled through the index, so that any trace order works and memory stays bounded: 24 bytes a trace
// while scanning (28 for a while where line numbers are suspect), 16 afterwards, and buffers of at most 48
// MiB or one run of traces. Based on: SEG Technical Standards, SEG-Y revisions 0, 1, 2.0 and 2.1; differs
// where real files differ (byte order of old revisions, header words that contradict each other, gaps,
// doubled traces).
#pragma once
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "storage/base/job_context.h"
#include "storage/formats/segy/header_word.h"
#include "storage/survey/geometry.h"

namespace footwall::formats::segy {

enum class Endian : std::uint8_t { kBig, kLittle };
std::string_view name_of(Endian endian);  // "big", "little"

// Byte numbers are those of the standard, from 1. What is not given comes from the preset, else from the
// file's own layout stanza, else from revision 1 (and the additional trace header of revision 2). Where
// neither lines nor preset are given and those make no grid, the one that the headers show beyond doubt is
// taken and said so in `assumed`.
struct Options {
  std::string preset;                        // see presets.h; empty = none
  std::optional<HeaderWord> inline_byte;     // 189
  std::optional<HeaderWord> crossline_byte;  // 193
  std::optional<HeaderWord> x_byte;          // 181, times the scalar at 71 where it is an integer
  std::optional<HeaderWord> y_byte;          // 185
  std::optional<int> coordinate_scalar;      // instead of the one at 71, for words of any type
  std::optional<int> format;                 // the sample format code, where the file's is wrong
  std::optional<Endian> endian;
  // In the vertical unit; the default is the header's number divided by 1000: microseconds to milliseconds,
  // and by custom millimetres to metres, or thousandths of a foot to feet, in depth.
  std::optional<double> interval;
  // SEG-Y cannot tell the domain: the caller asks its user for both and refuses to go on without them.
  survey::Domain domain = survey::Domain::kTime;
  survey::VerticalUnit vertical_unit = survey::VerticalUnit::kMillisecond;
  std::string crs;
};

// Headers that contradict each other.
struct Conflict {
  std::string what;          // e.g. "sample interval"
  double binary_header = 0;  // or the first trace's, for words that only traces have
  double trace_headers = 0;  // another value, of a trace header
  std::int64_t traces = 0;   // how many say otherwise
  double used = 0;
};

// Bins without a live trace, on one inline.
struct LineGap {
  std::int64_t line = 0;
  std::int64_t missing = 0;
  std::int64_t first = 0, last = 0;  // the crosslines between which they lie
};
struct Gaps {
  static constexpr std::size_t kListed = 100;
  std::int64_t lines = 0;        // inlines with some but not all bins missing
  std::int64_t whole_lines = 0;  // inlines without any trace
  std::vector<LineGap> listed;   // the first kListed of both kinds
};

// What `info FILE.sgy` prints. Filled as far as the file could be read.
struct Report {
  int format = 0;
  std::string format_name;  // e.g. "IBM float32"; empty for a code that is none
  Endian endian = Endian::kBig;
  int revision_major = 0;
  int revision_minor = 0;
  bool text_is_ebcdic = false;
  std::vector<std::string> text_header;           // 40 lines, UTF-8, trailing blanks removed
  std::vector<std::string> extended_text_header;  // all stanzas, one line each 80 columns
  std::int64_t traces = 0;                        // whole traces in the file
  std::int64_t samples = 0;                       // per trace
  double interval_us = 0;                         // as the header says it; 0 where it says nothing usable
  HeaderWord inline_word, crossline_word, x_word, y_word;  // where they were read
  bool x_y_scaled = false;                                 // by the scalar below
  int coordinate_scalar = 0;                               // as most traces have it, or as given
  std::int64_t live_traces = 0;                            // bins of the survey that have a live trace
  std::int64_t dead_traces = 0;                            // trace identification 2
  std::int64_t duplicates = 0;    // traces left out because an earlier one has the same lines
  std::int64_t odd_traces = 0;    // left out because their line numbers lie off the grid
  std::int64_t missing_bins = 0;  // bins of the survey without a live trace
  Gaps gaps;
  std::int64_t without_coordinates = 0;  // live traces whose X and Y are both zero, left out of the fit
  // Distance, in X/Y units, of the traces from the fitted map: root mean square and the largest; NaN where no
  // map was fitted.
  double residual = std::numeric_limits<double>::quiet_NaN();
  double largest_residual = std::numeric_limits<double>::quiet_NaN();
  std::string horizontal_unit;  // of X, Y and the residuals: "m" or "ft"
  bool right_handed = false;    // inline, crossline and down form a right-handed system in east, north, down
  std::vector<Conflict> conflicts;
  std::vector<std::string> warnings;
};

// True if the file can be recognised as SEG-Y, also where it cannot be imported (no traces, a format that is
// not read); never throws for its content.
bool looks_like_segy(const std::filesystem::path& path);

class SegyFile {
 public:
  // The header pass. Throws kNotFound, kIo; kFormat where the headers make no sense; kUnsupported for format
  // 4, unknown codes and prestack files; kInvalid for line numbers that make no grid; kUsage for byte
  // positions outside the header and unknown presets; kCancelled. Cancelled every few thousand traces.
  static SegyFile scan(const std::filesystem::path& path, const Options& options, const JobContext& job = {});

  SegyFile(SegyFile&&) noexcept;
  SegyFile& operator=(SegyFile&&) noexcept;
  ~SegyFile();

  const survey::Geometry& geometry() const;
  const Report& report() const;

  // values: box.count() floats, [inline][crossline][sample]; NaN where there is no live trace.
  // live: one byte for each trace of the box, [inline][crossline], 1 = live.
  // May be called from several threads; they take turns, since windows of the file are shared. Throws
  // kInternal for a box outside the survey or spans of another size, kIo, kCorrupt if the file has shrunk
  // since the scan.
  void read_block(const survey::Box& box, std::span<float> values, std::span<std::uint8_t> live) const;

  // Samples read so far that do not fit into a float32 and became +-FLT_MAX; counted at each reading.
  std::int64_t overflowed() const;

 private:
  struct State;
  explicit SegyFile(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace footwall::formats::segy
