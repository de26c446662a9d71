// What lies flat on the picture: labels of places in space, the panel of colour bars, the legend, title,
// north arrow.
#pragma once
#include <span>

#include "engine/render/camera.h"
#include "engine/render/canvas.h"
#include "engine/render/scene.h"
#include "engine/render/typeface.h"

namespace footwall::render {

// How wide the panels at the right edge are, in pixels of a picture with text_scale 1: the scene keeps out of
// there.
inline constexpr double kPanelWidth = 250;

// depth: the finished picture's, to find out what hides a label.
void draw_labels(Canvas& canvas, Typeface& typeface, const Scene& scene, const Camera& camera,
                 std::span<const float> depth);
// typeface may be null: the same without words.
void draw_panels(Canvas& canvas, Typeface* typeface, const Scene& scene);
void draw_title(Canvas& canvas, Typeface& typeface, const Scene& scene);
void draw_north_arrow(Canvas& canvas, Typeface* typeface, const Scene& scene, const Camera& camera);
// East, north and up as the camera sees them, named E, N and Z.
void draw_orientation_axes(Canvas& canvas, Typeface* typeface, const Scene& scene, const Camera& camera);

// The numbers beside a bar: equal steps from lo to hi, with a common power of ten taken out where they are
// very large or small (10^exponent, a multiple of 3).
struct BarTicks {
  std::vector<std::string> texts;  // from lo to hi
  int exponent = 0;
};
BarTicks ticks_of(const Range& range, int count);

}  // namespace footwall::render
