#include "storage/formats/segy/survey_look.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace footwall::formats::segy {
namespace {

// The cell of a line, and the lines of all cells before it.
std::int64_t cell_of(std::int64_t index, std::int64_t lines, std::int64_t cells) {
  return index * cells / lines;
}

std::int64_t step_for(std::int64_t count, std::int64_t most) {
  return std::max<std::int64_t>(1, (count + most - 1) / most);
}

}  // namespace

SurveyLook::SurveyLook(const std::filesystem::path& path, const Options& options, const JobContext& job)
    : file_(path) {
  SurveyScan scan;
  try {
    scan_survey(file_, options, true, job.part(0, 0.8), scan);
    found_.geometry = scan.geometry;
  } catch (const Error& error) {
    const ErrorCode code = error.code();
    if (code == ErrorCode::kUsage || code == ErrorCode::kIo || code == ErrorCode::kCancelled) throw;
    found_.refusal = error;
  }
  if (scan.has_lines) {
    found_.inlines = scan.geometry.inlines;
    found_.crosslines = scan.geometry.crosslines;
  }
  found_.report = std::move(scan.report);
  found_.candidates = std::move(scan.candidates);
  layout_ = std::move(scan.layout);
  index_ = std::move(scan.index);
  if (scan.has_lines) draw_map(job.part(0.8, 1));
}

void SurveyLook::draw_map(const JobContext& job) {
  // 1. The places of traces that share a bin: the scan's index has left them out.
  std::vector<IndexEntry> doubled;
  if (found_.report.duplicates > 0 || found_.refusal) {
    HeaderBytes at;
    at.inline_number = found_.report.inline_word;
    at.crossline_number = found_.report.crossline_word;
    at.x = found_.report.x_word;
    at.y = found_.report.y_word;
    Report again;
    HeaderScan headers = scan_headers(file_, layout_, at, again, job);
    headers.index.settle([&](const IndexEntry& kept, const IndexEntry& left_out) {
      if (!kept.dead() && !left_out.dead()) doubled.push_back(left_out);
    });
    headers.index.drop_dead();
    if (found_.refusal) index_ = std::move(headers.index);
  }

  // 2. How many live traces each cell has, and how many bins.
  const survey::LineAxis& inlines = *found_.inlines;
  const survey::LineAxis& crosslines = *found_.crosslines;
  map_.rows = std::min(inlines.count, TraceMap::kMostCells);
  map_.columns = std::min(crosslines.count, TraceMap::kMostCells);
  std::vector<std::int64_t> live(static_cast<std::size_t>(map_.rows * map_.columns));
  const auto place = [&](const IndexEntry& entry) -> std::int64_t {
    const std::int64_t i = inlines.index_of(entry.inline_number);
    const std::int64_t j = crosslines.index_of(entry.crossline_number);
    if (i < 0 || j < 0 || i >= inlines.count || j >= crosslines.count) return -1;
    return cell_of(i, inlines.count, map_.rows) * map_.columns + cell_of(j, crosslines.count, map_.columns);
  };
  for (const IndexEntry& entry : index_.entries()) {
    if (const std::int64_t at = place(entry); at >= 0) ++live[static_cast<std::size_t>(at)];
  }
  std::vector<std::int64_t> rows_of(static_cast<std::size_t>(map_.rows));
  std::vector<std::int64_t> columns_of(static_cast<std::size_t>(map_.columns));
  for (std::int64_t i = 0; i < inlines.count; ++i) {
    ++rows_of[static_cast<std::size_t>(cell_of(i, inlines.count, map_.rows))];
  }
  for (std::int64_t j = 0; j < crosslines.count; ++j) {
    ++columns_of[static_cast<std::size_t>(cell_of(j, crosslines.count, map_.columns))];
  }
  map_.cells.resize(live.size());
  for (std::size_t at = 0; at < live.size(); ++at) {
    const auto columns = static_cast<std::size_t>(map_.columns);
    map_.cells[at] = live[at] < rows_of[at / columns] * columns_of[at % columns] ? Bin::kHole : Bin::kLive;
  }
  for (const IndexEntry& entry : doubled) {
    if (const std::int64_t at = place(entry); at >= 0)
      map_.cells[static_cast<std::size_t>(at)] = Bin::kDuplicate;
  }
}

std::int64_t SurveyLook::bytes_read() const {
  return found_.geometry ? layout_.offset_of(layout_.traces) : 0;
}

std::int64_t SurveyLook::bytes_written() const {
  return found_.geometry ? found_.geometry->box().count() * static_cast<std::int64_t>(sizeof(float)) : 0;
}

LinePreview SurveyLook::line(bool of_inline, std::int64_t index, const JobContext& job) const {
  LinePreview preview;
  preview.of_inline = of_inline;
  if (!found_.inlines || layout_.format == nullptr || layout_.samples <= 0) return preview;
  const survey::LineAxis& along = of_inline ? *found_.inlines : *found_.crosslines;
  const survey::LineAxis& across = of_inline ? *found_.crosslines : *found_.inlines;
  preview.line = along.line_of(std::clamp<std::int64_t>(index, 0, along.count - 1));
  preview.trace_step = step_for(across.count, LinePreview::kMostTraces);
  preview.sample_step = step_for(layout_.samples, LinePreview::kMostSamples);
  preview.traces = (across.count + preview.trace_step - 1) / preview.trace_step;
  preview.samples = (layout_.samples + preview.sample_step - 1) / preview.sample_step;
  preview.values.assign(static_cast<std::size_t>(preview.traces * preview.samples),
                        std::numeric_limits<float>::quiet_NaN());

  const auto decode = layout_.swap ? layout_.format->decode_big : layout_.format->decode_little;
  std::vector<std::byte> bytes(static_cast<std::size_t>(layout_.samples * layout_.format->size));
  std::vector<float> trace(static_cast<std::size_t>(layout_.samples));
  for (std::int64_t n = 0; n < preview.traces; ++n) {
    job.check();
    const std::int64_t other = across.line_of(n * preview.trace_step);
    const std::int64_t inline_number = of_inline ? preview.line : other;
    const std::int64_t crossline_number = of_inline ? other : preview.line;
    const auto entries = index_.between(inline_number, crossline_number, crossline_number);
    if (entries.empty()) continue;
    file_.read_at(layout_.offset_of(entries.front().trace()) + layout_.trace_header_size, bytes);
    decode(bytes.data(), trace);
    for (std::int64_t k = 0; k < preview.samples; ++k) {
      preview.values[static_cast<std::size_t>(n * preview.samples + k)] =
          trace[static_cast<std::size_t>(k * preview.sample_step)];
    }
  }
  return preview;
}

}  // namespace footwall::formats::segy
