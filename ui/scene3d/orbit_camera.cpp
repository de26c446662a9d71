#include "ui/scene3d/orbit_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace footwall::ui {
namespace {

using render::Vec3;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kDegreesPerPixel = 0.4;
constexpr double kFill = 0.76;  // of the view, by what fit() shows: labels stand around it
const double kHalfCone = std::tan(render::Camera::kConeDegrees / 2 * kDegree);

double size_of(std::span<const Vec3> corners) {
  double size = 1e-3;
  for (const Vec3& p : corners) size = std::max(size, length(p - corners.front()));
  return size;
}

}  // namespace

Vec3 OrbitCamera::forward() const {
  const double a = azimuth_ * kDegree;
  const double e = elevation_ * kDegree;
  return {std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), -std::sin(e)};
}

Vec3 OrbitCamera::up() const {
  const double a = azimuth_ * kDegree;
  const double e = elevation_ * kDegree;
  return {std::sin(a) * std::sin(e), std::cos(a) * std::sin(e), std::cos(e)};
}

Vec3 OrbitCamera::eye() const {
  return target_ - forward() * distance_;
}

bool OrbitCamera::place(const Vec3& eye, const Vec3& target) {
  const Vec3 view = target - eye;
  const double far = length(view);
  if (!std::isfinite(far) || !(far > 0)) return false;
  target_ = target;
  distance_ = far;
  elevation_ = std::asin(std::clamp(-view.z / far, -1.0, 1.0)) / kDegree;
  if (std::hypot(view.x, view.y) > 1e-9 * far) azimuth_ = std::atan2(view.x, view.y) / kDegree;
  return true;
}

void OrbitCamera::set_direction(double azimuth_degrees, double elevation_degrees) {
  if (!std::isfinite(azimuth_degrees) || !std::isfinite(elevation_degrees)) return;
  azimuth_ = std::fmod(std::fmod(azimuth_degrees, 360) + 360, 360);
  elevation_ = std::clamp(elevation_degrees, -90.0, 90.0);
}

void OrbitCamera::look(StandardView view) {
  switch (view) {
    case StandardView::kTop:
      return set_direction(0, 90);
    case StandardView::kBottom:
      return set_direction(0, -90);
    case StandardView::kNorth:
      return set_direction(0, 0);
    case StandardView::kEast:
      return set_direction(90, 0);
    case StandardView::kSouth:
      return set_direction(180, 0);
    case StandardView::kWest:
      return set_direction(270, 0);
    case StandardView::kOblique:
      return set_direction(315, 28);
  }
}

void OrbitCamera::look_along(double side_degrees) {
  constexpr double kFromSide = 32;
  constexpr double kNorthWest = 315;
  double best = kNorthWest;
  double least = 360;
  for (int n = 0; n < 8; ++n) {
    const int quarters = n / 2;
    const double azimuth = side_degrees + 90.0 * quarters + (n % 2 == 0 ? kFromSide : -kFromSide);
    const double off = std::abs(std::remainder(azimuth - kNorthWest, 360));
    if (off >= least) continue;
    least = off;
    best = azimuth;
  }
  set_direction(best, 28);
}

void OrbitCamera::fit(const QSizeF& view) {
  const std::array<Vec3, 8> all = corners_;
  fit(view, all);
}

void OrbitCamera::fit(const QSizeF& view, std::span<const Vec3> corners) {
  if (corners.empty() || view.isEmpty()) return;
  Vec3 middle;
  for (const Vec3& p : corners) middle = middle + p * (1.0 / static_cast<double>(corners.size()));
  target_ = middle;
  distance_ = size_of(corners) / kHalfCone;
  // In perspective the picture's middle and size depend on the distance: a few steps settle both.
  for (int round = 0; round < 12; ++round) {
    const render::Camera seen = camera(view);
    std::array<double, 2> least{INFINITY, INFINITY};
    std::array<double, 2> most{-INFINITY, -INFINITY};
    for (const Vec3& p : corners) {
      const render::Vec4 clip = seen.clip_of(p);
      const double w = std::max(clip.w, 1e-9);
      least = {std::min(least[0], clip.x / w), std::min(least[1], clip.y / w)};
      most = {std::max(most[0], clip.x / w), std::max(most[1], clip.y / w)};
    }
    const double metres = kHalfCone * distance_;  // half of the lesser of width and height, at the target
    const double aspect = view.width() / view.height();
    target_ = target_ + seen.right * ((least[0] + most[0]) / 2 * metres * std::max(1.0, aspect)) +
              seen.up * ((least[1] + most[1]) / 2 * metres * std::max(1.0, 1 / aspect));
    const double half = std::max((most[0] - least[0]) / 2, (most[1] - least[1]) / 2);
    distance_ *= std::clamp(half / kFill, 0.2, 5.0);
  }
}

void OrbitCamera::orbit(double right, double down) {
  set_direction(azimuth_ + right * kDegreesPerPixel, elevation_ + down * kDegreesPerPixel);
}

double OrbitCamera::metres_per_pixel(const QSizeF& view) const {
  return 2 * kHalfCone * distance_ / std::max(1.0, std::min(view.width(), view.height()));
}

void OrbitCamera::pan(double right, double down, const QSizeF& view) {
  const double metres = metres_per_pixel(view);
  const Vec3 ahead = forward();
  const Vec3 above = up();
  target_ = target_ - cross(ahead, above) * (right * metres) + above * (down * metres);
}

void OrbitCamera::zoom(double factor, const Vec3& at) {
  const double size = size_of(corners_);
  // Nearer, the target would lie before what depths can tell apart.
  const double wanted = std::clamp(distance_ * factor, size * 6e-3, size * 100);
  const double share = wanted / distance_;
  target_ = at + (target_ - at) * share;
  distance_ = wanted;
}

void OrbitCamera::stretch(double factor) {
  target_.z *= factor;
}

render::Camera OrbitCamera::camera(const QSizeF& view) const {
  return render::Camera::look_at(eye(), target_, up(), corners_,
                                 std::max(1.0, view.width()) / std::max(1.0, view.height()), perspective_);
}

Ray OrbitCamera::ray(const QPointF& pixel, const QSizeF& view) const {
  const double per_pixel = metres_per_pixel(view);
  const Vec3 ahead = forward();
  const Vec3 above = up();
  const Vec3 off = cross(ahead, above) * ((pixel.x() - view.width() / 2) * per_pixel) +
                   above * ((view.height() / 2 - pixel.y()) * per_pixel);
  if (perspective_) {
    const Vec3 along = ahead * distance_ + off;
    return {eye(), along * (1 / length(along))};
  }
  // From far enough behind to meet all that is in front, too.
  return {target_ + off - ahead * (distance_ + 2 * size_of(corners_)), ahead};
}

bool project_to(const render::Camera& camera, const QSizeF& view, const Vec3& place, QPointF* pixel,
                double* depth) {
  const render::Vec4 clip = camera.clip_of(place);
  if (!(clip.w > 0) || !(clip.z > -clip.w)) return false;
  *pixel = {(clip.x / clip.w * 0.5 + 0.5) * view.width(), (0.5 - clip.y / clip.w * 0.5) * view.height()};
  if (depth != nullptr) *depth = clip.z / clip.w;
  return true;
}

}  // namespace footwall::ui
