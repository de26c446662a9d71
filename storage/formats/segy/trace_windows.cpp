#include "storage/formats/segy/trace_windows.h"

namespace footwall::formats::segy {
namespace {

constexpr std::int64_t kWindowBytes = std::int64_t{1} << 20;
// Shorter pieces are read through the page cache, which can have them under way before they are needed.
constexpr std::int64_t kWorthDirect = std::int64_t{256} << 10;
constexpr std::int64_t kSteps = 8;

using Way = detail::PageBuffer::Way;

Way way_for(std::int64_t bytes) {
  return bytes >= kWorthDirect ? Way::kPastCache : Way::kThroughCache;
}

std::int64_t bytes_in(std::int64_t traces, const Layout& layout) {
  return traces * layout.trace_size;
}

}  // namespace

std::size_t TraceWindows::holding(const TraceRun& run, const Layout& layout) const {
  const auto found = std::find_if(windows_.begin(), windows_.end(), [&](const Window& window) {
    return window.buffer.holds(layout.offset_of(run.first), bytes_in(run.count, layout));
  });
  return static_cast<std::size_t>(found - windows_.begin());
}

void TraceWindows::ask_for(const TraceRun& run, std::int64_t runs, const detail::ReadOnlyFile& file,
                           const Layout& layout) const {
  if (runs > 1 && way_for(bytes_in(run.count + run.next, layout)) == Way::kThroughCache &&
      holding(run, layout) == windows_.size()) {
    file.will_need(layout.offset_of(run.first), bytes_in(run.count, layout));
  }
}

// One that is used up, else a new one, else the one that was not used for longest.
TraceWindows::Window& TraceWindows::free_window() {
  const auto oldest =
      std::min_element(windows_.begin(), windows_.end(),
                       [](const Window& a, const Window& b) { return a.last_used < b.last_used; });
  const bool full = static_cast<std::int64_t>(windows_.size()) >= kBytes / kWindowBytes;
  if (oldest != windows_.end() && (oldest->last_used == 0 || full)) return *oldest;
  return windows_.emplace_back();
}

const std::byte* TraceWindows::bytes_of(const TraceRun& run, std::int64_t runs,
                                        const detail::ReadOnlyFile& file, const Layout& layout) {
  const std::int64_t offset = layout.offset_of(run.first);
  const std::int64_t end = run.first + run.count;
  const std::size_t held = holding(run, layout);
  Window* window = held < windows_.size() ? &windows_[held] : nullptr;
  if (window == nullptr) {
    const auto before = static_cast<std::int64_t>(windows_.size());
    window = &free_window();
    window->end = end;
    // A run that is cached needs no window: the shorter the piece, the nearer it is when it is decoded.
    if (!window->buffer.read_if_cached(file, offset, bytes_in(run.count, layout))) {
      std::int64_t wanted = std::min(kWindowBytes, kBytes / runs);
      // The first windows have different lengths, so that later they are not all used up in the same block:
      // reading goes on evenly beside decoding.
      if (static_cast<std::int64_t>(windows_.size()) > before)
        wanted = wanted * (1 + before % kSteps) / kSteps;
      window->end += std::clamp<std::int64_t>(wanted / layout.trace_size - run.count, 0, run.next);
      const std::int64_t bytes = bytes_in(window->end - run.first, layout);
      window->buffer.read(file, offset, bytes, way_for(bytes));
    }
  }
  window->last_used = end == window->end ? 0 : ++time_;
  return window->buffer.at(offset);
}

}  // namespace footwall::formats::segy
