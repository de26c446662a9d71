#include "storage/formats/segy/header_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace footwall::formats::segy {
namespace {

constexpr std::int64_t kChunkBytes = std::int64_t{4} << 20;
// Traces longer than this are skipped over; reading the headers alone is then faster than reading everything.
constexpr std::int64_t kLongTrace = std::int64_t{16} << 10;
constexpr std::int64_t kReportEvery = 4096;  // traces

// Calls on_header(trace, header) for each trace in file order.
template <class OnHeader>
void for_each_header(const detail::ReadOnlyFile& file, const Layout& layout, const JobContext& job,
                     const OnHeader& on_header) {
  const bool skip = layout.trace_size > kLongTrace;
  const std::int64_t per_read = skip ? 1 : std::max<std::int64_t>(1, kChunkBytes / layout.trace_size);
  const auto header_bytes = static_cast<std::size_t>(layout.header_bytes());
  std::vector<std::byte> buffer(skip ? header_bytes : static_cast<std::size_t>(per_read * layout.trace_size));
  skip ? file.expect_scattered() : file.expect_sequential();
  for (std::int64_t first = 0; first < layout.traces; first += per_read) {
    const std::int64_t count = std::min(per_read, layout.traces - first);
    const auto bytes = skip ? header_bytes : static_cast<std::size_t>(count * layout.trace_size);
    file.read_at(layout.offset_of(first), std::span(buffer).first(bytes));
    for (std::int64_t n = 0; n < count; ++n) {
      const std::byte* header = buffer.data() + n * layout.trace_size;
      on_header(first + n, std::span<const std::byte>(header, header_bytes));
    }
    if (!skip || first % kReportEvery == 0) {
      job.report(static_cast<double>(first) / static_cast<double>(layout.traces), "scan trace headers",
                 fmt::format("{} of {} traces", first, layout.traces));
    }
  }
}

static_assert(sizeof(IndexEntry) + sizeof(Offset2) == 24, "what a scan keeps of each trace");

void add_to(HeaderScan& scan, const TraceHeader& header) {
  scan.delay_ms.add(header.delay_ms);
  if (header.interval_us != 0) scan.interval_us.add(header.interval_us);
  if (header.samples != 0) scan.samples.add(header.samples);
  scan.coordinate_unit.add(header.coordinate_unit);
  scan.largest = std::max({scan.largest, std::fabs(header.x), std::fabs(header.y)});
  Moments& moments = header.x == 0 && header.y == 0 ? scan.at_zero : scan.positions;
  moments.add(header.inline_number, header.crossline_number, header.x, header.y);
  scan.scalars.add(header.coordinate_scalar);
}

Offset2 offset_from(const Moments& first, const TraceHeader& header) {
  if (header.x == 0 && header.y == 0) {
    constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
    return {kNone, kNone};
  }
  return {static_cast<float>(header.x - first.x0), static_cast<float>(header.y - first.y0)};
}

}  // namespace

void CommonWord::add(double word) {
  ++count;
  if (!stated) {
    stated = true;
    value = word;
  } else if (word != value) {
    ++differing;
    other = word;
  }
}

void Scalars::add(int scalar) {
  for (auto& [value, count] : counts) {
    if (value == scalar) {
      ++count;
      return;
    }
  }
  if (counts.size() < kMost) {
    counts.emplace_back(scalar, 1);
  } else {
    ++others;
  }
}

int Scalars::most_common() const {
  const auto most = std::max_element(counts.begin(), counts.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == counts.end() ? 1 : most->first;
}

HeaderScan scan_headers(const detail::ReadOnlyFile& file, const Layout& layout, const HeaderBytes& at,
                        Report& report, const JobContext& job) {
  HeaderScan scan;
  HeaderScan of_dead;  // needed only where all are marked dead, which is known at the end
  scan.index.reserve(layout.traces);
  scan.offsets.reserve(static_cast<std::size_t>(layout.traces));
  for_each_header(file, layout, job, [&](std::int64_t trace, std::span<const std::byte> bytes) {
    const TraceHeader header = read_trace_header(bytes, at, layout.swap, trace);
    IndexEntry entry{header.inline_number, header.crossline_number, static_cast<std::uint64_t>(trace)};
    if (header.dead) {
      ++scan.dead;
      add_to(of_dead, header);
      // Needed where all are dead; beside live ones nobody asks where they are.
      scan.offsets.push_back(offset_from(of_dead.positions, header));
      // Padding often has no line numbers at all; it must not stretch the survey to line 0.
      if (header.inline_number == 0 && header.crossline_number == 0) return;
      entry.order |= IndexEntry::kDead;
    } else {
      ++scan.live;
      add_to(scan, header);
      scan.offsets.push_back(offset_from(scan.positions, header));
    }
    scan.index.add(entry);
  });
  if (scan.live == 0) {
    of_dead.index = std::move(scan.index);
    of_dead.index.revive();
    of_dead.live = scan.dead;
    of_dead.offsets = std::move(scan.offsets);
    scan = std::move(of_dead);
    report.warnings.emplace_back("every trace is marked dead (trace identification 2): the mark is ignored");
  }
  job.report(1, "scan trace headers", fmt::format("{0} of {0} traces", layout.traces));
  return scan;
}

}  // namespace footwall::formats::segy
