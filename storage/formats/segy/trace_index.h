// From line numbers to the trace in the file: a sorted table of 16 bytes a trace.
#pragma once
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

namespace footwall::formats::segy {

struct IndexEntry {
  std::int32_t inline_number = 0;
  std::int32_t crossline_number = 0;
  std::uint64_t order = 0;  // the trace's number in the file; dead ones come after all live ones

  static constexpr std::uint64_t kDead = std::uint64_t{1} << 63;
  bool dead() const { return (order & kDead) != 0; }
  std::int64_t trace() const { return static_cast<std::int64_t>(order & ~kDead); }
  bool same_bin(const IndexEntry& other) const {
    return inline_number == other.inline_number && crossline_number == other.crossline_number;
  }
  friend auto operator<=>(const IndexEntry&, const IndexEntry&) = default;
};

class TraceIndex {
 public:
  void reserve(std::int64_t traces) { entries_.reserve(static_cast<std::size_t>(traces)); }
  void add(const IndexEntry& entry) { entries_.push_back(entry); }
  // Sorts by inline, crossline, live before dead, place in the file; calls for each entry after the first of
  // its bin, then removes it.
  template <class OnDuplicate>
  void settle(const OnDuplicate& on_duplicate);
  void drop_dead();
  template <class Predicate>
  void erase_if(const Predicate& predicate) {
    std::erase_if(entries_, predicate);
  }
  // Marks all entries as live.
  void revive();

  const std::vector<IndexEntry>& entries() const { return entries_; }
  // The entries of one inline between two crosslines, both included; after settle().
  std::span<const IndexEntry> between(std::int64_t line, std::int64_t first_crossline,
                                      std::int64_t last_crossline) const;

 private:
  void sort();
  std::vector<IndexEntry> entries_;
};

template <class OnDuplicate>
void TraceIndex::settle(const OnDuplicate& on_duplicate) {
  sort();
  std::size_t kept = 0;
  for (std::size_t n = 0; n < entries_.size(); ++n) {
    if (kept > 0 && entries_[n].same_bin(entries_[kept - 1])) {
      on_duplicate(entries_[kept - 1], entries_[n]);
    } else {
      entries_[kept++] = entries_[n];
    }
  }
  entries_.resize(kept);
}

}  // namespace footwall::formats::segy
