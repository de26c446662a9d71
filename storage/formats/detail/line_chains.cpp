#include "storage/formats/detail/line_chains.h"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

namespace footwall::formats::detail {
namespace {

// One end of a segment, at its point.
struct End {
  std::size_t point, segment, other;
};

void leave_out_repeated(std::vector<Segment>& segments) {
  const auto key = [](const Segment& s) { return std::pair(std::min(s.a, s.b), std::max(s.a, s.b)); };
  std::vector<std::size_t> order(segments.size());
  for (std::size_t n = 0; n < order.size(); ++n) order[n] = n;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t m, std::size_t n) { return key(segments[m]) < key(segments[n]); });
  const auto repeated = std::unique(order.begin(), order.end(), [&](std::size_t m, std::size_t n) {
    return key(segments[m]) == key(segments[n]);
  });
  order.erase(repeated, order.end());
  std::sort(order.begin(), order.end());
  for (std::size_t n = 0; n < order.size(); ++n) segments[n] = segments[order[n]];
  segments.resize(order.size());
}

class Walk {
 public:
  explicit Walk(const std::vector<Segment>& segments) : used_(segments.size(), false) {
    for (std::size_t n = 0; n < segments.size(); ++n) {
      ends_.push_back({segments[n].a, n, segments[n].b});
      ends_.push_back({segments[n].b, n, segments[n].a});
    }
    std::sort(ends_.begin(), ends_.end(), [](const End& m, const End& n) {
      return std::tie(m.point, m.segment) < std::tie(n.point, n.segment);
    });
  }

  std::span<const End> ends() const { return ends_; }
  bool is_used(const End& end) const { return used_[end.segment]; }
  std::span<const End> ends_at(std::size_t point) const {
    const auto [from, to] = std::equal_range(ends_.begin(), ends_.end(), End{point, 0, 0},
                                             [](const End& m, const End& n) { return m.point < n.point; });
    return {from, to};
  }

  std::vector<std::size_t> along(End end) {
    const std::size_t start = end.point;
    std::vector<std::size_t> chain{start};
    while (true) {
      used_[end.segment] = true;
      chain.push_back(end.other);
      if (end.other == start) return chain;
      const std::span<const End> next = ends_at(end.other);
      if (next.size() != 2) return chain;
      end = next[used_[next[0].segment] ? 1 : 0];
    }
  }

 private:
  std::vector<End> ends_;
  std::vector<bool> used_;
};

}  // namespace

std::vector<std::vector<std::size_t>> line_chains(std::size_t first, std::size_t last,
                                                  std::vector<Segment> segments) {
  leave_out_repeated(segments);
  Walk walk(segments);
  std::vector<std::vector<std::size_t>> chains;
  for (const End& end : walk.ends()) {
    if (!walk.is_used(end) && walk.ends_at(end.point).size() != 2) chains.push_back(walk.along(end));
  }
  for (const End& end : walk.ends()) {
    if (!walk.is_used(end)) chains.push_back(walk.along(end));
  }
  for (std::size_t point = first; point < last; ++point) {
    if (walk.ends_at(point).empty()) chains.push_back({point});
  }
  return chains;
}

}  // namespace footwall::formats::detail
