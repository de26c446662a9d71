// A coverage mask the slow way: a byte for every pixel, triangles by the definition of coverage, rectangles
// pixel by pixel. Also the visibility pass of seed 003, section 3.2, as it is printed: entries 0, 1 and 2.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "engine/verify/coverage_by_definition.h"

namespace footwall::verify {

class CoveredPixels {
 public:
  CoveredPixels(int width, int height)
      : width_(width),
        height_(height),
        entries_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

  // 0: not covered, 1: by a triangle, 2: by a box in this pass.
  int entry(int x, int y) const { return entries_[at(x, y)]; }
  std::int64_t uncovered() const;  // entries 0

  // Sets to 1 what the triangle covers.
  void cover(const RasterPoint& a, const RasterPoint& b, const RasterPoint& c, std::int64_t parts);
  // Half-open, cut at the picture. Sets to 1.
  void fill(int x0, int y0, int x1, int y1);
  bool covers(int x0, int y0, int x1, int y1) const;  // whether no entry there is 0 (or none is there)

  enum class Outcome : std::uint8_t { kVisible, kHidden, kUndetermined };
  // The three cases; a visible one's rectangle becomes 2 where it was 0.
  Outcome classify(int x0, int y0, int x1, int y1);
  void end_pass();  // 2 becomes 0

 private:
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  template <class Visit>
  void for_each_in(int x0, int y0, int x1, int y1, Visit&& visit) const;

  int width_;
  int height_;
  std::vector<std::uint8_t> entries_;
};

}  // namespace footwall::verify
