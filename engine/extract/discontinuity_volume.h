// The discontinuity attribute of a volume: at every voxel 1 - sum(num) / sum(den) over the samples of a
// vertical window, with num and den of the traces around at each sample as for faces (statistics/
// discontinuity.h): the same rounding, the same sums, and with 3x3 traces the very same numbers. 0 where
// traces are alike, towards 1 where they are not; high = fault.
//
// Nulls and edges: a trace that is null at a sample, or outside the survey, drops out there; m is how many
// are left. A sample with fewer than 4 traces (or fewer than all, of windows with fewer than 4) drops out, as
// do samples outside the survey. The voxel is null where no sample is left or all that are left are zeros.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "storage/survey/box.h"

namespace footwall::extract {

struct Window {
  std::int64_t inlines = 3;
  std::int64_t crosslines = 3;
  std::int64_t samples = 9;
  friend bool operator==(const Window&, const Window&) = default;
};

// "3x3x9": inlines x crosslines x samples. Throws kUsage for other texts, for even numbers, for more than 31
// lines or 255 samples, and for a window of one trace.
Window parse_window(std::string_view text);
std::string text_of(const Window& window);

// The box whose values decide those of `box`, inside the survey.
survey::Box needed_for(const survey::Box& box, const Window& window, const survey::Index& dims);

// Computes the attribute of boxes; one object per thread, its buffers are kept.
class DiscontinuityVolume {
 public:
  // max_abs: max |V| of the whole volume, which scales the fixed point.
  DiscontinuityVolume(const Window& window, const survey::Index& dims, double max_abs);

  // values: of needed_for(box), [inline][crossline][sample], NaN for nulls; out: of box, NaN for nulls. Any
  // way of cutting the survey into boxes gives the same bits. Throws kCorrupt for a value far above max_abs.
  void compute(const survey::Box& box, std::span<const float> values, std::span<float> out);

 private:
  Window window_;
  survey::Index dims_;
  double scale_;
  double fewest_;
  std::vector<double> sum_, squares_, traces_;  // of each sample of the trace at hand
  std::vector<std::int64_t> num_, den_;
};

}  // namespace footwall::extract
