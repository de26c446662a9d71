// The one pass over all trace headers.
#pragma once
#include <utility>
#include <vector>

#include "storage/base/job_context.h"
#include "storage/formats/segy/layout.h"
#include "storage/formats/segy/map_fit.h"
#include "storage/formats/segy/trace_header.h"
#include "storage/formats/segy/trace_index.h"

namespace footwall::formats::segy {

// A word that should be the same in all traces: its value in the first one that states it, and how many
// differ.
struct CommonWord {
  bool stated = false;
  std::int64_t count = 0;  // of traces that state it
  double value = 0;
  std::int64_t differing = 0;
  double other = 0;  // one of the differing values

  void add(double word);
};

// The coordinate scalars that the traces have, as far as they are few.
struct Scalars {
  static constexpr std::size_t kMost = 16;
  std::vector<std::pair<int, std::int64_t>> counts;
  std::int64_t others = 0;

  void add(int scalar);
  // The one that most traces have; 1 without traces.
  int most_common() const;
  bool agree() const { return counts.size() <= 1; }
};

// Where a trace lies, relative to the fit's first one; float is good to a centimetre 100 km away.
struct Offset2 {
  float x = 0;
  float y = 0;
};

struct HeaderScan {
  TraceIndex index;    // in file order, not settled
  Moments positions;   // of traces whose X and Y are not both zero
  Moments at_zero;     // of those whose are
  double largest = 0;  // |X| or |Y|
  std::int64_t live = 0;
  std::int64_t dead = 0;
  CommonWord delay_ms, interval_us, samples, coordinate_unit;
  Scalars scalars;
  // One a trace, in file order, relative to (positions.x0, positions.y0); NaN where X and Y are both zero.
  std::vector<Offset2> offsets;
};

// Dead traces count only in `dead` and as entries marked dead; if every trace is marked dead the mark is
// taken as meaningless and all count as live (a warning says so). Reports progress from 0 to 1; throws
// kCancelled, kIo.
HeaderScan scan_headers(const detail::ReadOnlyFile& file, const Layout& layout, const HeaderBytes& at,
                        Report& report, const JobContext& job);

}  // namespace footwall::formats::segy
