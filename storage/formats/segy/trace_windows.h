// Reads runs of traces in longer pieces than are asked for, where what follows will be asked for soon: a
// block of a file in inline order is a short run of every inline, and the next block begins where those runs
// end.
#pragma once
#include <cstdint>
#include <vector>

#include "storage/formats/detail/page_buffer.h"
#include "storage/formats/segy/layout.h"

namespace footwall::formats::segy {

// Traces that follow each other in the file.
struct TraceRun {
  std::int64_t first = 0;
  std::int64_t count = 0;
  std::int64_t next = 0;  // traces right behind them that the next blocks will want
};

// Not for several threads at once. Memory: 48 MiB, or one run where that is longer.
class TraceWindows {
 public:
  static constexpr std::int64_t kBytes = std::int64_t{48} << 20;

  // Where the run's bytes are, headers included, until the next call. `runs`: how many windows are in use
  // side by side; they share the memory. Throws kIo, kMemory, kCorrupt.
  const std::byte* bytes_of(const TraceRun& run, std::int64_t runs, const detail::ReadOnlyFile& file,
                            const Layout& layout);
  // Has the system fetch a run that bytes_of() will want and would read through the page cache. The disk then
  // works on many short runs at once.
  void ask_for(const TraceRun& run, std::int64_t runs, const detail::ReadOnlyFile& file,
               const Layout& layout) const;

 private:
  struct Window {
    detail::PageBuffer buffer;
    std::int64_t end = 0;        // the trace behind the last one
    std::int64_t last_used = 0;  // 0: all of it has been asked for
  };
  // The place of the window that has the run; windows_.size() where none has.
  std::size_t holding(const TraceRun& run, const Layout& layout) const;
  Window& free_window();

  std::vector<Window> windows_;
  std::int64_t time_ = 0;
};

}  // namespace footwall::formats::segy
