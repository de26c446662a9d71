// Where to look from when nobody has said: the direction that shows most of the faults without hiding the
// sections.
#pragma once
#include <span>
#include <vector>

#include "engine/render/rasterizer.h"
#include "engine/render/scene_frame.h"

namespace footwall::render {

struct Surface {
  std::vector<Vec3f> positions;
  std::vector<TriangleIndices> triangles;
};

// An azimuth in [0, 360) out of twelve at 30, 45 and 60 degrees to the survey's own lines: the one with the
// greatest product of the pixels seen of each surface in a small picture. A product, so that a fault half
// seen is worth more than another wholly seen; sections count with their square root, and not at all where
// they stand between the eye and the survey's middle. The same input gives the same answer.
double best_azimuth(const SceneFrame& frame, std::span<const Surface> faults,
                    std::span<const Surface> sections, double elevation_degrees, bool perspective);

}  // namespace footwall::render
