// Where line numbers and coordinates may stand, judged by what the trace headers hold.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "storage/formats/segy/header_scan.h"
#include "storage/formats/segy/layout.h"

namespace footwall::formats::segy {

// A pair of words that numbers the traces like the bins of a grid. All figures come from up to 2,000 traces
// at the file's start, middle and end.
struct LineCandidate {
  HeaderWord inline_word, crossline_word;
  HeaderWord x, y;           // the coordinates that suit these lines best; kNoWord where none do
  std::string preset;        // its name, where it is one
  std::int64_t inlines = 1;  // lines between the lowest and highest number seen
  std::int64_t crosslines = 1;
  double hits = 0;  // share of neighbouring traces in the file that are neighbours on a line
  double fill = 0;  // traces of the file a bin, 1 at most
  double misfit =
      0;  // root mean square distance of X, Y from the affine map, in bins; NaN without coordinates
  double score = 0;        // 0 to 1
  bool one_offset = true;  // all traces have one offset, as stacked ones do
};

// Best first, 16 at most, none where there are too few traces to tell. Words that hold the same numbers,
// maybe in other units, are listed once, under the most usual place. Of a pair, the line number that changes
// more slowly through the file is taken for the inline, unless a preset says else.
std::vector<LineCandidate> find_candidates(const detail::ReadOnlyFile& file, const Layout& layout);

// The first one, if it fits its coordinates and no other comes near it.
std::optional<LineCandidate> beyond_doubt(const std::vector<LineCandidate>& candidates);

}  // namespace footwall::formats::segy
