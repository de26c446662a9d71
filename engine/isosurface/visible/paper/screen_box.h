// Where a box of the volume is in the picture.
#pragma once
#include "engine/render/coverage_mask.h"
#include "engine/render/vector.h"
#include "storage/survey/box.h"

namespace footwall::isosurface {

// The rectangle of all pixels that a surface inside `cells` can be drawn on, rounding to sub-pixels included,
// cut at the picture; empty where there are none. A box that reaches behind the eye is cut at the near plane
// first; where a number is not finite it is the whole picture. to_clip: from the volume's index space. Based
// on: seed 003, section 3.1 ("projected bounding box").
render::PixelRect screen_box(const survey::Box& cells, const render::Matrix4& to_clip, int width, int height);

}  // namespace footwall::isosurface
