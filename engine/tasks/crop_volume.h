// A part of a volume on its way in: ranges of lines and of z, with strides, whatever the kind of file.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/tasks/add_volume.h"

namespace footwall::tasks {

// Both ends are included; an end that is left out is the file's. step: a whole multiple of the file's.
struct LineRange {
  std::optional<std::int64_t> first, last, step;
};
// In the vertical unit.
struct DepthRange {
  std::optional<double> first, last, step;
};
struct Crop {
  std::optional<LineRange> inlines, crosslines;
  std::optional<DepthRange> z;

  bool whole() const { return !inlines && !crosslines && !z; }
};

// The source's part inside the ranges. Ends beyond the file are clipped, with a line in `notices`; the ranges
// are added to the provenance as "crop". Memory while filling: one inline of the source's block, from its
// first to its last wanted crossline (a trace at a time where that is above 64 MiB). Throws kUsage for steps
// that are no multiple of the file's, kInvalid, with the file's ranges, where nothing is left.
VolumeSource cropped(VolumeSource source, const Crop& crop, std::vector<std::string>& notices);

}  // namespace footwall::tasks
