// Labels of places in space: each stands where its place is seen and no earlier label is in the way.
#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/render/overlay.h"

namespace footwall::render {
namespace {

// A label's own line or surface is a little nearer than its anchor.
constexpr float kTolerance = 0.004F;
constexpr Rgba kHalo = rgb(16, 18, 22, 215);

struct Rectangle {
  double x0, y0, x1, y1;
  bool meets(const Rectangle& o) const { return x0 < o.x1 && o.x0 < x1 && y0 < o.y1 && o.y0 < y1; }
};

}  // namespace

void draw_labels(Canvas& canvas, Typeface& typeface, const Scene& scene, const Camera& camera,
                 std::span<const float> depth) {
  // Title and panels are drawn over the labels: nothing is to stand there.
  const double s = scene.text_scale;
  std::vector<Rectangle> taken;
  const double title =
      std::max(typeface.width(scene.title, 24 * s, true), typeface.width(scene.subtitle, 16 * s));
  if (title > 0) taken.push_back({0, 0, 28 * s + title, 82 * s});
  if (!scene.bars.empty() || !scene.legend.empty())
    taken.push_back({canvas.width() - kPanelWidth * s, 0, 1.0 * canvas.width(), 1.0 * canvas.height()});
  for (const Label& label : scene.labels) {
    const double width = typeface.width(label.text, label.size, label.bold);
    for (const Vec3& anchor : label.anchors) {
      const Vec4 clip = camera.clip_of(anchor);
      if (!(clip.w > 0)) continue;
      const double x = (clip.x / clip.w * 0.5 + 0.5) * canvas.width();
      const double y = (0.5 - clip.y / clip.w * 0.5) * canvas.height();
      if (!(x >= 0 && y >= 0 && x < canvas.width() && y < canvas.height())) continue;
      const float in_front = depth[static_cast<std::size_t>(y) * static_cast<std::size_t>(canvas.width()) +
                                   static_cast<std::size_t>(x)];
      if (static_cast<float>(clip.z / clip.w * 0.5 + 0.5) > in_front + kTolerance) continue;
      const double share = label.align == Align::kLeft ? 0 : label.align == Align::kCentre ? 0.5 : 1;
      const double left = x + label.shift_x - share * width;
      const double baseline =
          y + label.shift_y + 0.36 * label.size;  // the reference point is the text's middle
      const Rectangle place{left - 3, baseline - label.size, left + width + 3, baseline + 0.35 * label.size};
      if (place.x0 < 0 || place.y0 < 0 || place.x1 > canvas.width() || place.y1 > canvas.height()) continue;
      bool crowded = false;
      for (const Rectangle& other : taken) crowded = crowded || place.meets(other);
      if (crowded) continue;
      taken.push_back(place);
      typeface.draw(canvas, left, baseline, label.text, label.size, label.colour, label.bold, kHalo);
      break;
    }
  }
}

}  // namespace footwall::render
