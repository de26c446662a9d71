#include "engine/verify/covered_by_definition.h"

#include <algorithm>

namespace footwall::verify {

template <class Visit>
void CoveredPixels::for_each_in(int x0, int y0, int x1, int y1, Visit&& visit) const {
  for (int y = std::max(y0, 0); y < std::min(y1, height_); ++y) {
    for (int x = std::max(x0, 0); x < std::min(x1, width_); ++x) visit(at(x, y));
  }
}

std::int64_t CoveredPixels::uncovered() const {
  return std::count(entries_.begin(), entries_.end(), 0);
}

void CoveredPixels::cover(const RasterPoint& a, const RasterPoint& b, const RasterPoint& c,
                          std::int64_t parts) {
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      if (verify::covers(a, b, c, x, y, parts)) entries_[at(x, y)] = 1;
    }
  }
}

void CoveredPixels::fill(int x0, int y0, int x1, int y1) {
  for_each_in(x0, y0, x1, y1, [&](std::size_t n) { entries_[n] = 1; });
}

bool CoveredPixels::covers(int x0, int y0, int x1, int y1) const {
  bool all = true;
  for_each_in(x0, y0, x1, y1, [&](std::size_t n) { all = all && entries_[n] != 0; });
  return all;
}

CoveredPixels::Outcome CoveredPixels::classify(int x0, int y0, int x1, int y1) {
  std::array<std::int64_t, 3> count{};
  for_each_in(x0, y0, x1, y1, [&](std::size_t n) { ++count[entries_[n]]; });
  if (count[0] > 0) {
    for_each_in(x0, y0, x1, y1, [&](std::size_t n) {
      if (entries_[n] == 0) entries_[n] = 2;
    });
    return Outcome::kVisible;
  }
  return count[2] == 0 ? Outcome::kHidden : Outcome::kUndetermined;
}

void CoveredPixels::end_pass() {
  std::replace(entries_.begin(), entries_.end(), std::uint8_t{2}, std::uint8_t{0});
}

}  // namespace footwall::verify
