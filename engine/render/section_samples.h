// The value of a section between and over its samples.
#pragma once
#include "engine/render/scene.h"

namespace footwall::render {

// Whether texels are large enough to be shown as they are: where one step between the picture's samples
// passes over row_step x column_step texels and a pixel has per_pixel steps each way, a texel covers more
// than 6 pixels.
bool shows_squares(double row_step, double column_step, int per_pixel);

// At texel coordinates (row, column). Squares: the nearest texel. Else neighbours are interpolated, and
// averaged where steps pass over several. Nulls (NaN) stay null.
double section_value(const SectionPlane& section, double row, double column, double row_step,
                     double column_step, bool squares);

}  // namespace footwall::render
