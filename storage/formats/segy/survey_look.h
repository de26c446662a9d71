// What a person wants to see of a SEG-Y file before it is imported: what the headers hold, where the traces
// lie, and single lines of samples.
#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "storage/formats/detail/read_only_file.h"
#include "storage/formats/segy/survey_scan.h"

namespace footwall::formats::segy {

enum class Bin : std::uint8_t { kHole, kLive, kDuplicate };

// The bins seen from above, [inline][crossline], lowest numbers first. One cell a bin; where an axis has more
// than kMostCells lines a cell stands for several, and shows the duplicate among them before the hole, the
// hole before live.
struct TraceMap {
  static constexpr std::int64_t kMostCells = 1024;
  std::int64_t rows = 0;     // along the inline axis; 0 where the lines are not known
  std::int64_t columns = 0;  // along the crossline axis
  std::vector<Bin> cells;

  Bin at(std::int64_t row, std::int64_t column) const {
    return cells[static_cast<std::size_t>(row * columns + column)];
  }
};

// Samples of one line, [trace][sample], NaN where there is no live trace. Every trace_step-th trace and
// sample_step-th sample, so that it stays a picture whatever the file's size.
struct LinePreview {
  static constexpr std::int64_t kMostTraces = 1200;
  static constexpr std::int64_t kMostSamples = 2048;
  bool of_inline = true;
  std::int64_t line = 0;  // its number
  std::int64_t traces = 0, samples = 0;
  std::int64_t trace_step = 1, sample_step = 1;
  std::vector<float> values;
};

class SurveyLook {
 public:
  // The header pass, as inspect(), and once more where duplicates have to be found or the file is refused.
  // Throws what inspect() throws.
  SurveyLook(const std::filesystem::path& path, const Options& options, const JobContext& job);

  const Inspection& found() const { return found_; }
  const TraceMap& map() const { return map_; }
  // What an import reads of the file, and writes of samples; 0 where it is refused.
  std::int64_t bytes_read() const;
  std::int64_t bytes_written() const;

  // The line at this index of its axis, clamped; empty where the lines are not known. Throws kIo, kCorrupt,
  // kCancelled.
  LinePreview line(bool of_inline, std::int64_t index, const JobContext& job) const;

 private:
  void draw_map(const JobContext& job);

  detail::ReadOnlyFile file_;
  Inspection found_;
  Layout layout_;
  TraceIndex index_;  // settled
  TraceMap map_;
};

}  // namespace footwall::formats::segy
