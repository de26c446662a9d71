// What sharing geometry and merging pictures cost, and how much of either there is: so that two neighbours
// can tell which is the quicker.
#pragma once
#include <cstdint>
#include <span>

#include "engine/render/camera.h"
#include "engine/render/lit_surface.h"

namespace footwall::render {

// Seconds, of one rank by the clock.
struct GroupRates {
  double geometry_byte = 0;  // packed, sent and unpacked
  double triangle = 0;       // a small one: projected, and found to lie outside the rank's rows
  double drawn = 0;          // more for one inside
  double shaded = 0;         // a pixel that shows something
  double merged = 0;         // the same: packed, sent and merged
  double background = 0;     // a pixel of the rank's rows that shows nothing: cleared and looked at
};
inline constexpr double GroupRates::*kGroupRates[] = {&GroupRates::geometry_byte, &GroupRates::triangle,
                                                      &GroupRates::drawn,         &GroupRates::shaded,
                                                      &GroupRates::merged,        &GroupRates::background};

// Bytes of a pixel that is sent to be merged, without those of the runs.
inline constexpr double kMergedPixelBytes = 12;

// Of drawing a small made surface, in the calling thread's processor time; what is sent is not in it. Takes
// some milliseconds. Throws std::bad_alloc.
GroupRates measure_drawing();

// About how many pixels of a picture the surfaces cover, from some of their triangles: never more than the
// picture has, and 0 for none.
std::int64_t covered_pixels(std::span<const LitSurface> surfaces, const Camera& camera, int width,
                            int height);

}  // namespace footwall::render
