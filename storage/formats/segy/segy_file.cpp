#include "storage/formats/segy/segy_file.h"

#include <atomic>
#include <limits>

#include "storage/base/error.h"
#include "storage/formats/segy/survey_scan.h"

namespace footwall::formats::segy {
namespace {

// What one read may bring in, if a single trace is not larger.
constexpr std::int64_t kMostBytes = std::int64_t{4} << 20;

struct Wanted {
  std::int64_t trace;
  std::int64_t row;  // in the block: (i, j) in order
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

  std::vector<Wanted> traces_in(const survey::Box& box) const;
  void decode_run(std::span<const Wanted> run, const survey::Box& box, std::vector<std::byte>& buffer,
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

// In the order of the file, so that neighbouring traces are read together whatever the file's sorting.
std::vector<Wanted> SegyFile::State::traces_in(const survey::Box& box) const {
  std::vector<Wanted> wanted;
  for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
    const auto found = index.between(geometry.inlines.line_of(i), geometry.crosslines.line_of(box.lo[1]),
                                     geometry.crosslines.line_of(box.hi[1] - 1));
    for (const IndexEntry& entry : found) {
      const std::int64_t j = geometry.crosslines.index_of(entry.crossline_number) - box.lo[1];
      wanted.push_back({entry.trace(), (i - box.lo[0]) * box.size(1) + j});
    }
  }
  std::sort(wanted.begin(), wanted.end(), [](const Wanted& a, const Wanted& b) { return a.trace < b.trace; });
  return wanted;
}

// One read from the first sample wanted of the run's first trace to the last one of its last trace.
void SegyFile::State::decode_run(std::span<const Wanted> run, const survey::Box& box,
                                 std::vector<std::byte>& buffer, std::span<float> values) const {
  const SampleFormat& format = *layout.format;
  const std::int64_t column = box.size(2);
  const std::int64_t skipped = layout.trace_header_size + box.lo[2] * format.size;
  const std::int64_t span = (run.back().trace - run.front().trace) * layout.trace_size + column * format.size;
  buffer.resize(std::max(buffer.size(), static_cast<std::size_t>(span)));
  file.read_at(layout.offset_of(run.front().trace) + skipped,
               std::span(buffer).first(static_cast<std::size_t>(span)));
  const auto decode = layout.swap ? format.decode_big : format.decode_little;
  std::int64_t beyond = 0;
  for (const Wanted& wanted : run) {
    const std::byte* samples = buffer.data() + (wanted.trace - run.front().trace) * layout.trace_size;
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

  // Traces that follow each other in the file are one read, unless most of what lies between is not wanted.
  const std::int64_t column_bytes = box.size(2) * state.layout.format->size;
  const bool together = state.layout.trace_size <= std::max<std::int64_t>(2 * column_bytes, 4096);
  std::vector<std::byte> buffer;
  for (std::size_t first = 0; first < wanted.size();) {
    std::size_t end = first + 1;
    while (together && end < wanted.size() && wanted[end].trace == wanted[end - 1].trace + 1 &&
           (wanted[end].trace - wanted[first].trace + 1) * state.layout.trace_size <= kMostBytes) {
      ++end;
    }
    state.decode_run(std::span(wanted).subspan(first, end - first), box, buffer, values);
    first = end;
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
