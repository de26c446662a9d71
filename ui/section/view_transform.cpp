#include "ui/section/view_transform.h"

#include <algorithm>
#include <cmath>

namespace footwall::ui {
namespace {

constexpr double kMostPixelsPerVoxel = 2000;
constexpr double kLeastPixelsOfPlane = 40;
constexpr double kLeastStretch = 1e-4;
constexpr double kMostStretch = 1e4;

double length_of(const survey::WorldPoint& a, const survey::WorldPoint& b, const survey::Geometry& survey) {
  return std::abs(survey.horizontal_metres(std::hypot(a.x - b.x, a.y - b.y)));
}

double usable(double metres) {
  return std::isfinite(metres) && metres > 0 ? metres : 1;
}

// The largest of a few round numbers x 10^n that is not above.
double round_down(double factor) {
  const double decade = std::pow(10.0, std::floor(std::log10(factor)));
  double best = decade;
  for (const double digit : {1.2, 1.5, 1.8, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0}) {
    if (digit * decade <= factor * (1 + 1e-9)) best = digit * decade;
  }
  return best;
}

}  // namespace

PlaneFrame frame_of(const Section& section, const survey::Geometry& survey, double velocity) {
  PlaneFrame frame;
  frame.size = size_of(section, survey);
  const survey::WorldPoint origin = survey.world_of({0, 0, 0});
  const double per_inline = usable(length_of(survey.world_of({1, 0, 0}), origin, survey));
  const double per_crossline = usable(length_of(survey.world_of({0, 1, 0}), origin, survey));
  frame.metres_per_v =
      usable(std::abs(survey.vertical_metres(survey.interval, velocity > 0 ? velocity : 2000)));
  switch (section.kind) {
    case Section::Kind::kInline:
      frame.metres_per_u = per_crossline;
      break;
    case Section::Kind::kCrossline:
      frame.metres_per_u = per_inline;
      break;
    case Section::Kind::kSlice: {
      frame.metres_per_u = per_crossline;
      frame.metres_per_v = per_inline;
      frame.vertical = false;
      const survey::MapView& map = survey.map;
      frame.upward = map.per_crossline_x * map.per_inline_y - map.per_crossline_y * map.per_inline_x > 0;
      break;
    }
    case Section::Kind::kLine: {
      const double voxels = std::hypot(section.to.i - section.from.i, section.to.j - section.from.j);
      frame.metres_per_u =
          usable(length_of(survey.world_of(section.from), survey.world_of(section.to), survey) / voxels);
      break;
    }
  }
  return frame;
}

void ViewTransform::set_frame(const PlaneFrame& frame) {
  const bool same_plane = frame.vertical == frame_.vertical && frame.size.width == frame_.size.width &&
                          frame.size.height == frame_.size.height;
  frame_ = frame;
  if (fitted_ || !same_plane) {
    fit(true_proportions_);
  } else {
    clamp();
  }
}

void ViewTransform::set_area(const QRectF& area) {
  area_ = area;
  area_.setWidth(std::max(area.width(), 1.0));
  area_.setHeight(std::max(area.height(), 1.0));
  if (fitted_) {
    fit(true_proportions_);
  } else {
    clamp();
  }
}

void ViewTransform::fit(bool true_proportions) {
  centre_ = {(frame_.size.width - 1) / 2, (frame_.size.height - 1) / 2};
  const double by_width = area_.width() / (frame_.size.width * frame_.metres_per_u);
  const double by_height = area_.height() / (frame_.size.height * frame_.metres_per_v);
  stretch_ = 1;
  if (frame_.vertical && !true_proportions)
    stretch_ = std::clamp(round_down(by_height / by_width), kLeastStretch, kMostStretch);
  scale_ = std::min(by_width, by_height / stretch_);
  fitted_ = true;
  true_proportions_ = true_proportions;
}

void ViewTransform::show(const PlanePoint& low, const PlanePoint& high) {
  centre_ = {(low.u + high.u) / 2, (low.v + high.v) / 2};
  const double width = std::max(high.u - low.u, 8.0) * 1.3;
  const double height = std::max(high.v - low.v, 8.0) * 1.3;
  scale_ = std::min(area_.width() / (width * frame_.metres_per_u),
                    area_.height() / (height * frame_.metres_per_v * stretch_));
  fitted_ = false;
  clamp();
}

void ViewTransform::zoom(const QPointF& at, double factor) {
  const PlanePoint under = to_plane(at);
  scale_ *= factor;
  fitted_ = false;
  clamp();
  const QPointF now = to_pixels(under);
  pan(at - now);
}

void ViewTransform::stretch(const QPointF& at, double factor) {
  const PlanePoint under = to_plane(at);
  stretch_ = std::clamp(stretch_ * factor, kLeastStretch, kMostStretch);
  fitted_ = false;
  clamp();
  const QPointF now = to_pixels(under);
  pan(at - now);
}

void ViewTransform::pan(const QPointF& by) {
  if (by.isNull()) return;
  centre_.u -= by.x() / pixels_per_u();
  centre_.v -= by.y() / pixels_per_v() * (frame_.upward ? -1 : 1);
  fitted_ = false;
  clamp_centre();
}

bool ViewTransform::show_part(const ShownPart& part) {
  if (part.fits) {
    fit(part.true_proportions);
    return true;
  }
  const auto is_scale = [](double x) { return std::isfinite(x) && x > 0; };
  if (!is_scale(part.pixels_per_metre) || !is_scale(part.stretch) || !std::isfinite(part.centre.u) ||
      !std::isfinite(part.centre.v))
    return false;
  fitted_ = false;
  centre_ = part.centre;
  scale_ = part.pixels_per_metre;
  stretch_ = std::clamp(part.stretch, kLeastStretch, kMostStretch);
  clamp();
  clamp_centre();
  return true;
}

void ViewTransform::show_around(const PlanePoint& centre, double height, double stretch) {
  fitted_ = false;
  centre_ = centre;
  stretch_ = stretch;
  scale_ = area_.height() / (height * frame_.metres_per_v * stretch_);
  clamp();
  clamp_centre();
}

void ViewTransform::show_heights(double centre, double height) {
  fitted_ = false;
  centre_.v = centre;
  stretch_ =
      std::clamp(area_.height() / (height * frame_.metres_per_v * scale_), kLeastStretch, kMostStretch);
  clamp();
  clamp_centre();
}

QPointF ViewTransform::to_pixels(const PlanePoint& p) const {
  const double down = (p.v - centre_.v) * pixels_per_v();
  return area_.center() + QPointF((p.u - centre_.u) * pixels_per_u(), frame_.upward ? -down : down);
}

PlanePoint ViewTransform::to_plane(const QPointF& p) const {
  const QPointF from = p - area_.center();
  const double down = from.y() / pixels_per_v();
  return {centre_.u + from.x() / pixels_per_u(), centre_.v + (frame_.upward ? -down : down)};
}

// Some of the plane stays in the view.
void ViewTransform::clamp_centre() {
  centre_.u = std::clamp(centre_.u, -0.5, frame_.size.width - 0.5);
  centre_.v = std::clamp(centre_.v, -0.5, frame_.size.height - 0.5);
}

void ViewTransform::clamp() {
  const double least = std::min(kLeastPixelsOfPlane / (frame_.size.width * frame_.metres_per_u),
                                kLeastPixelsOfPlane / (frame_.size.height * frame_.metres_per_v * stretch_));
  const double most = std::min(kMostPixelsPerVoxel / frame_.metres_per_u,
                               kMostPixelsPerVoxel / (frame_.metres_per_v * stretch_));
  scale_ = std::clamp(scale_, std::min(least, most), most);
}

}  // namespace footwall::ui
