// A plane of the survey by the words of --section.
#pragma once
#include <cstdint>
#include <string>

#include "storage/survey/geometry.h"

namespace footwall::tasks {

struct SectionPlane {
  int axis = 0;            // 0 inline, 1 crossline, 2 sample
  std::int64_t index = 0;  // from the survey's first line or sample
};

// "inline=N", "crossline=N" by line number, "z=VALUE" in the vertical unit, positive down, rounded to the
// nearest sample; first, middle and last are numbers too. Throws kUsage for other words, kInvalid naming the
// survey's range for a plane that it does not have.
SectionPlane section_plane(const std::string& words, const survey::Geometry& survey);

}  // namespace footwall::tasks
