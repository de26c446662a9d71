#include "ui/scene3d/survey_box.h"

#include <QCoreApplication>
#include <QFontMetricsF>
#include <algorithm>
#include <cmath>

#include "engine/render/axes.h"
#include "ui/scene3d/orbit_camera.h"

namespace footwall::ui {
namespace {

using render::Vec3;
using render::Vec3f;

struct Axis {
  QString title;
  double first = 0, last = 1, step = 1;
};

class Box {
 public:
  Box(const render::SceneFrame& frame, const render::Camera& camera, const QSizeF& view,
      const SceneColours& colours, TextImages& texts)
      : camera_(camera), view_(view), colours_(colours), texts_(texts), corners_(frame.corners()) {
    for (std::size_t n = 0; n < 8; ++n) {
      seen_[n] = project_to(camera, view, corners_[n], &at_[n]);
      away_[n] = dot(corners_[n] - camera.eye, camera.forward);
    }
    middle_ = (corners_[0] + corners_[7]) * 0.5;
    size_ = length(corners_[7] - corners_[0]);
    project_to(camera, view, middle_, &middle_at_);
  }

  void add_edges() {
    const auto farthest = static_cast<unsigned>(std::ranges::max_element(away_) - away_.begin());
    for (unsigned axis = 0; axis < 3; ++axis) {
      for (const unsigned corner : render::edges_along(axis)) {
        const unsigned other = corner | 1U << axis;
        const bool behind = corner == farthest || other == farthest;
        QColor colour = behind ? colours_.line : colours_.dim;
        if (!behind) colour.setAlphaF(0.75F);
        add_line(corners_[corner], corners_[other], colour, behind ? 1.0F : 1.2F);
      }
    }
  }

  void add_axis(unsigned axis, const Axis& what) {
    const unsigned corner = axis == 2 ? standing_edge() : nearest_edge(axis);
    const unsigned other = corner | 1U << axis;
    if (!seen_[corner] || !seen_[other]) return;
    const QPointF along = at_[other] - at_[corner];
    const double far = std::hypot(along.x(), along.y());
    if (far < 60) return;  // seen end-on: its numbers would be a heap
    QPointF out(-along.y() / far, along.x() / far);
    const QPointF off = (at_[corner] + at_[other]) / 2 - middle_at_;
    if (QPointF::dotProduct(out, off) < 0) out = -out;
    Vec3 outwards = (corners_[corner] + corners_[other]) * 0.5 - middle_;
    outwards.z = 0;
    outwards = outwards * (0.012 * size_ / std::max(length(outwards), 1e-9));
    const double spacing = std::abs(along.x()) > std::abs(along.y()) ? 76 : 48;
    const auto count = static_cast<int>(std::clamp(far / spacing, 2.0, 12.0));
    double widest = 0;
    for (const double number : render::round_numbers(what.first, what.last, count, what.step)) {
      const double share = (number - what.first + what.step / 2) / (what.last - what.first + what.step);
      const Vec3 at = corners_[corner] + (corners_[other] - corners_[corner]) * share;
      add_line(at, at + outwards, colours_.dim, 1.2F);
      const QString words = QString::number(number, 'g', 10);
      widest = std::max(widest, texts_.size_of(words).width());
      add_text(words, at, out, 9, colours_.dim, false);
    }
    if (axis == 2) {
      // Over the upper end: beside the numbers it would need much room.
      const unsigned top = at_[corner].y() < at_[other].y() ? corner : other;
      add_text(what.title, corners_[top], {out.x() < 0 ? -0.3 : 0.3, -1}, 10, colours_.text, false);
      return;
    }
    const double room = 22 + std::abs(out.x()) * widest + std::abs(out.y()) * 10;
    add_text(what.title, (corners_[corner] + corners_[other]) * 0.5, out, room, colours_.text, false);
  }

  BoxMarks take() { return std::move(marks_); }

 private:
  // Of the two edges on the floor (from below: the roof), the one in front.
  unsigned nearest_edge(unsigned axis) const {
    const bool from_above = camera_.forward.z <= 0;
    unsigned best = 8;
    for (const unsigned corner : render::edges_along(axis)) {
      if (((corner & 4U) != 0) != from_above) continue;
      const auto away = [&](unsigned c) { return away_[c] + away_[c | 1U << axis]; };
      if (best == 8 || away(corner) < away(best)) best = corner;
    }
    return best;
  }
  // The leftmost or rightmost of the standing ones: that which stands farther from the floor's labels.
  unsigned standing_edge() const {
    const std::array<unsigned, 4> edges = render::edges_along(2);
    const auto across = [this](unsigned corner) { return at_[corner].x() + at_[corner | 4U].x(); };
    const unsigned left = *std::ranges::min_element(edges, {}, across);
    const unsigned right = *std::ranges::max_element(edges, {}, across);
    const auto room = [&](unsigned corner) {
      double least = INFINITY;
      for (const unsigned axis : {0U, 1U}) {
        const unsigned floor = nearest_edge(axis);
        const QPointF middle = (at_[floor] + at_[floor | 1U << axis]) / 2;
        const QPointF off = (at_[corner] + at_[corner | 4U]) / 2 - middle;
        least = std::min(least, std::hypot(off.x(), off.y()));
      }
      return least;
    };
    return room(left) >= room(right) ? left : right;
  }
  void add_line(const Vec3& a, const Vec3& b, const QColor& colour, float width) {
    marks_.lines.push_back({Vec3f(a), Vec3f(b), rgba_of(colour), width});
  }
  // The nearest point of the text's box lies `away` pixels outwards.
  void add_text(const QString& text, const Vec3& at, const QPointF& out, double away, const QColor& colour,
                bool bold) {
    const QImage& image = texts_.of(text, colour, bold);
    const QSizeF size = image.deviceIndependentSize();
    const double reach = std::abs(out.x()) * size.width() / 2 + std::abs(out.y()) * size.height() / 2;
    const QPointF centre = out * (away + reach);
    marks_.labels.push_back({image, Vec3f(at), centre - QPointF(size.width() / 2, size.height() / 2), false});
  }

  const render::Camera& camera_;
  QSizeF view_;
  const SceneColours& colours_;
  TextImages& texts_;
  std::array<Vec3, 8> corners_;
  std::array<QPointF, 8> at_{};
  std::array<bool, 8> seen_{};
  std::array<double, 8> away_{};
  Vec3 middle_;
  QPointF middle_at_;
  double size_ = 1;
  BoxMarks marks_;
};

}  // namespace

void TextImages::set_style(const QFont& font, const QColor& halo, double pixel) {
  if (font == font_ && halo == halo_ && pixel == pixel_) return;
  images_.clear();
  font_ = font;
  halo_ = halo;
  pixel_ = pixel;
}

QFont TextImages::font_of(bool bold) const {
  QFont font = font_;
  font.setBold(bold);
  return font;
}

QSizeF TextImages::size_of(const QString& text, bool bold) const {
  const QFontMetricsF metrics(font_of(bold));
  return {metrics.horizontalAdvance(text), metrics.height()};
}

const QImage& TextImages::of(const QString& text, const QColor& colour, bool bold) {
  constexpr int kMostKept = 500;
  const QString key = colour.name() + (bold ? u'b' : u'-') + text;
  const auto found = images_.constFind(key);
  if (found != images_.constEnd()) return *found;
  if (images_.size() > kMostKept) images_.clear();
  return *images_.insert(key, text_image(text, font_of(bold), colour, halo_, pixel_));
}

BoxMarks box_marks(const render::SceneFrame& frame, const render::Camera& camera, const QSizeF& view,
                   const SceneColours& colours, TextImages& texts) {
  const survey::Geometry& g = frame.geometry();
  const auto tr = [](const char* words) { return QCoreApplication::translate("SceneView", words); };
  Box box(frame, camera, view, colours, texts);
  box.add_edges();
  const QString unit = QString::fromUtf8(name_of(g.vertical_unit).data());
  box.add_axis(2, {(g.domain == survey::Domain::kTime ? tr("time") : tr("depth")) + u' ' + unit, g.z0,
                   g.z0 + g.interval * static_cast<double>(g.samples - 1), g.interval});
  box.add_axis(0, {tr("inline"), static_cast<double>(g.inlines.first), static_cast<double>(g.inlines.last()),
                   static_cast<double>(g.inlines.step)});
  box.add_axis(1, {tr("crossline"), static_cast<double>(g.crosslines.first),
                   static_cast<double>(g.crosslines.last()), static_cast<double>(g.crosslines.step)});
  return box.take();
}

}  // namespace footwall::ui
