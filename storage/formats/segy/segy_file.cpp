#include "storage/formats/segy/segy_file.h"

#include <atomic>
#include <limits>
#include <mutex>

#include "storage/base/error.h"
#include "storage/formats/segy/survey_scan.h"
#include "storage/formats/segy/trace_windows.h"

namespace footwall::formats::segy {
namespace {

// What one read may bring in, if a single trace is not larger.
constexpr std::int64_t kMostBytes = std::int64_t{4} << 20;
// The traces behind a run that may be read with it.
constexpr std::int64_t kMostNext = 4096;

struct Wanted {
  std::int64_t trace;
  std::int64_t row;   // in the block: (i, j) in order
  std::int64_t next;  // traces behind it that lie further along the inline, outside the block
};

}  // namespace

struct SegyFile::State {
  explicit State(const std::filesystem::path& path) : file(path) {}

  detail::ReadOnlyFile file;
  Layout layout;
  survey::Geometry geometry;
  Report report;
  TraceIndex index;
  mutable std::atomic<std::int64_t> overflowed{0};

  // What read_block works with, one call at a time.
  mutable std::mutex reading;
  mutable TraceWindows windows;

  std::vector<Wanted> traces_in(const survey::Box& box) const;
  std::vector<std::span<const Wanted>> runs_of(std::span<const Wanted> wanted, const survey::Box& box) const;
  void decode_run(std::span<const Wanted> run, const survey::Box& box, const std::byte* first_sample,
                  std::span<float> values) const;
};

SegyFile::SegyFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
SegyFile::SegyFile(SegyFile&&) noexcept = default;
SegyFile& SegyFile::operator=(SegyFile&&) noexcept = default;
SegyFile::~SegyFile() = default;

SegyFile SegyFile::scan(const std::filesystem::path& path, const Options& options, const JobContext& job) {
  auto state = std::make_unique<State>(path);
  SurveyScan scan;
  scan_survey(state->file, options, false, job, scan);
  state->layout = std::move(scan.layout);
  state->geometry = std::move(scan.geometry);
  state->report = std::move(scan.report);
  state->index = std::move(scan.index);
  state->file.expect_scattered();
  return SegyFile(std::move(state));
}

const survey::Geometry& SegyFile::geometry() const {
  return state_->geometry;
}
const Report& SegyFile::report() const {
  return state_->report;
}
std::int64_t SegyFile::overflowed() const {
  return state_->overflowed.load();
}

// How many traces lie in the file right behind the last one found, further along its inline.
std::int64_t following(std::span<const IndexEntry> all, std::span<const IndexEntry> found) {
  const IndexEntry& last = found.back();
  const IndexEntry* end = all.data() + all.size();
  std::int64_t count = 0;
  for (const IndexEntry* entry = &last + 1; entry < end && count < kMostNext; ++entry, ++count) {
    if (entry->inline_number != last.inline_number || entry->trace() != last.trace() + count + 1) break;
  }
  return count;
}

// In the order of the file, so that neighbouring traces are read together whatever the file's sorting.
std::vector<Wanted> SegyFile::State::traces_in(const survey::Box& box) const {
  std::vector<Wanted> wanted;
  for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
    const auto found = index.between(geometry.inlines.line_of(i), geometry.crosslines.line_of(box.lo[1]),
                                     geometry.crosslines.line_of(box.hi[1] - 1));
    for (const IndexEntry& entry : found) {
      const std::int64_t j = geometry.crosslines.index_of(entry.crossline_number) - box.lo[1];
      wanted.push_back({entry.trace(), (i - box.lo[0]) * box.size(1) + j, 0});
    }
    if (!found.empty()) wanted.back().next = following(index.entries(), found);
  }
  std::sort(wanted.begin(), wanted.end(), [](const Wanted& a, const Wanted& b) { return a.trace < b.trace; });
  return wanted;
}

// Traces that follow each other in the file are one read, unless most of what lies between is not wanted.
std::vector<std::span<const Wanted>> SegyFile::State::runs_of(std::span<const Wanted> wanted,
                                                              const survey::Box& box) const {
  const bool together =
      layout.trace_size <= std::max<std::int64_t>(2 * box.size(2) * layout.format->size, 4096);
  std::vector<std::span<const Wanted>> runs;
  for (std::size_t first = 0; first < wanted.size();) {
    std::size_t end = first + 1;
    while (together && end < wanted.size() && wanted[end].trace == wanted[end - 1].trace + 1 &&
           (wanted[end].trace - wanted[first].trace + 1) * layout.trace_size <= kMostBytes) {
      ++end;
    }
    runs.push_back(wanted.subspan(first, end - first));
    first = end;
  }
  return runs;
}

void SegyFile::State::decode_run(std::span<const Wanted> run, const survey::Box& box,
                                 const std::byte* first_sample, std::span<float> values) const {
  const std::int64_t column = box.size(2);
  const auto decode = layout.swap ? layout.format->decode_big : layout.format->decode_little;
  std::int64_t beyond = 0;
  for (const Wanted& wanted : run) {
    const std::byte* samples = first_sample + (wanted.trace - run.front().trace) * layout.trace_size;
    beyond += decode(samples, values.subspan(static_cast<std::size_t>(wanted.row * column),
                                             static_cast<std::size_t>(column)));
  }
  overflowed += beyond;
}

void SegyFile::read_block(const survey::Box& box, std::span<float> values,
                          std::span<std::uint8_t> live) const {
  const State& state = *state_;
  require(survey::intersection(box, state.geometry.box()) == box && !box.empty(),
          "the box lies inside the survey");
  require(values.size() == static_cast<std::size_t>(box.count()), "values hold one float a voxel of the box");
  require(live.size() == static_cast<std::size_t>(box.size(0) * box.size(1)),
          "live holds one byte a trace of the box");

  const std::vector<Wanted> wanted = state.traces_in(box);
  std::fill(live.begin(), live.end(), std::uint8_t{0});
  for (const Wanted& trace : wanted) live[static_cast<std::size_t>(trace.row)] = 1;

  const Layout& layout = state.layout;
  const std::int64_t skipped = layout.trace_header_size + box.lo[2] * layout.format->size;
  const std::int64_t column_bytes = box.size(2) * layout.format->size;
  const auto runs = state.runs_of(wanted, box);
  const std::scoped_lock lock(state.reading);
  const auto as_run = [](std::span<const Wanted> run) {
    return TraceRun{run.front().trace, static_cast<std::int64_t>(run.size()), run.back().next};
  };
  if (layout.trace_size > std::max<std::int64_t>(2 * column_bytes, 4096)) {
    // Little of each trace is wanted: only that is read.
    std::vector<std::byte> samples(static_cast<std::size_t>(column_bytes));
    for (const auto& run : runs) {
      state.file.read_at(layout.offset_of(run.front().trace) + skipped, samples);
      state.decode_run(run, box, samples.data(), values);
    }
  } else {
    const auto count = static_cast<std::int64_t>(runs.size());
    for (const auto& run : runs) state.windows.ask_for(as_run(run), count, state.file, layout);
    for (const auto& run : runs) {
      const std::byte* bytes = state.windows.bytes_of(as_run(run), count, state.file, layout);
      state.decode_run(run, box, bytes + skipped, values);
    }
  }

  const auto column = static_cast<std::size_t>(box.size(2));
  for (std::size_t row = 0; row < live.size(); ++row) {
    if (live[row] == 0) {
      std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(row * column), column,
                  std::numeric_limits<float>::quiet_NaN());
    }
  }
}

}  // namespace footwall::formats::segy
