#include "storage/formats/segy/header_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "storage/base/byte_rate.h"
#include "storage/formats/detail/page_buffer.h"

namespace footwall::formats::segy {
namespace {

constexpr std::int64_t kPieceBytes = std::int64_t{2} << 20;
// Traces longer than this are skipped over; reading the headers alone is then faster than reading everything.
constexpr std::int64_t kLongTrace = std::int64_t{64} << 10;
constexpr std::int64_t kAhead = 256;       // headers of long traces that are asked for at once
constexpr double kFastDisk = 200e6;        // bytes a second
constexpr std::int64_t kTried = 64 << 20;  // bytes, after which the disk's speed is known
constexpr const char* kPhase = "read headers";

using Header = std::span<const std::byte>;

// The samples are needed soon after: a disk that is slower than kFastDisk had better be read once, through
// the page cache. Past it, a fast one is read twice in less processor time than the cache would take.
class ReadingWay {
 public:
  detail::PageBuffer::Way way() const { return way_; }
  void through_cache() { way_ = detail::PageBuffer::Way::kThroughCache; }
  // `waited` for this read alone: a machine that is busy elsewhere does not make its disk slow.
  void after_read(std::int64_t bytes, std::chrono::duration<double> waited) {
    read_ += bytes;
    waited_ += waited;
    if (read_ >= kTried && static_cast<double>(read_) < kFastDisk * waited_.count()) through_cache();
  }

 private:
  std::int64_t read_ = 0;
  std::chrono::duration<double> waited_{0};
  detail::PageBuffer::Way way_ = detail::PageBuffer::Way::kPastCache;
};

// Calls on_header(trace, header) for each trace in file order; `in_rows` tells after the first piece whether
// traces that follow each other belong to one inline, so that blocks will be read in long pieces too.
template <class OnHeader, class InRows>
void read_all(const detail::ReadOnlyFile& file, const Layout& layout, const JobContext& job,
              const OnHeader& on_header, const InRows& in_rows) {
  const std::int64_t per_read = std::max<std::int64_t>(1, kPieceBytes / layout.trace_size);
  const std::int64_t total = layout.traces * layout.trace_size;
  ByteRate rate(total);
  const auto header_bytes = static_cast<std::size_t>(layout.header_bytes());
  ReadingWay way;
  detail::PageBuffer piece;
  file.expect_sequential();
  for (std::int64_t first = 0; first < layout.traces; first += per_read) {
    const std::int64_t done = first * layout.trace_size;
    const auto now = std::chrono::steady_clock::now();
    job.report(static_cast<double>(done) / static_cast<double>(total), kPhase, rate.text(done, now));
    if (first == per_read && !in_rows()) way.through_cache();
    const std::int64_t count = std::min(per_read, layout.traces - first);
    const auto asked = std::chrono::steady_clock::now();
    piece.read(file, layout.offset_of(first), count * layout.trace_size, way.way());
    way.after_read(count * layout.trace_size, std::chrono::steady_clock::now() - asked);
    for (std::int64_t n = first; n < first + count; ++n) {
      on_header(n, Header(piece.at(layout.offset_of(n)), header_bytes));
    }
  }
}

template <class OnHeader>
void read_headers_only(const detail::ReadOnlyFile& file, const Layout& layout, const JobContext& job,
                       const OnHeader& on_header) {
  std::vector<std::byte> header(static_cast<std::size_t>(layout.header_bytes()));
  file.expect_scattered();
  const auto ask_for = [&](std::int64_t first) {
    for (std::int64_t n = first; n < std::min(layout.traces, first + kAhead); ++n) {
      file.will_need(layout.offset_of(n), layout.header_bytes());
    }
  };
  ask_for(0);
  for (std::int64_t n = 0; n < layout.traces; ++n) {
    if (n % kAhead == 0) {
      ask_for(n + kAhead);
      job.report(static_cast<double>(n) / static_cast<double>(layout.traces), kPhase,
                 fmt::format("{} of {} traces", n, layout.traces));
    }
    file.read_at(layout.offset_of(n), header);
    on_header(n, header);
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
  const auto on_header = [&](std::int64_t trace, Header bytes) {
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
  };
  const auto in_rows = [&] {
    const auto& entries = scan.index.entries();
    return entries.size() < 2 || entries[0].inline_number == entries[1].inline_number;
  };
  if (layout.trace_size > kLongTrace) {
    read_headers_only(file, layout, job, on_header);
  } else {
    read_all(file, layout, job, on_header, in_rows);
  }
  if (scan.live == 0) {
    of_dead.index = std::move(scan.index);
    of_dead.index.revive();
    of_dead.live = scan.dead;
    of_dead.offsets = std::move(scan.offsets);
    scan = std::move(of_dead);
    report.warnings.emplace_back("every trace is marked dead (trace identification 2): the mark is ignored");
  }
  job.report(1, kPhase, fmt::format("{0} of {0} traces", layout.traces));
  return scan;
}

}  // namespace footwall::formats::segy
