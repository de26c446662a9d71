#include "storage/formats/segy/trace_index.h"

#include <algorithm>

namespace footwall::formats::segy {

void TraceIndex::sort() {
  // Most files are sorted already, and checking costs one pass.
  if (!std::is_sorted(entries_.begin(), entries_.end())) std::sort(entries_.begin(), entries_.end());
}

void TraceIndex::drop_dead() {
  std::erase_if(entries_, [](const IndexEntry& entry) { return entry.dead(); });
}

void TraceIndex::revive() {
  for (IndexEntry& entry : entries_) entry.order &= ~IndexEntry::kDead;
}

std::span<const IndexEntry> TraceIndex::between(std::int64_t line, std::int64_t first_crossline,
                                                std::int64_t last_crossline) const {
  using Key = std::pair<std::int64_t, std::int64_t>;
  const auto before = [](const IndexEntry& entry, const Key& key) {
    return Key(entry.inline_number, entry.crossline_number) < key;
  };
  const auto first = std::lower_bound(entries_.begin(), entries_.end(), Key(line, first_crossline), before);
  const auto last = std::lower_bound(first, entries_.end(), Key(line, last_crossline + 1), before);
  return {first, last};
}

}  // namespace footwall::formats::segy
