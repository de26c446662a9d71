#include "engine/render/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "storage/base/error.h"

namespace footwall::render {
namespace {

// Of the cone around the box; wider looks dramatic and distorts dips.
constexpr double kHalfFieldDegrees = Camera::kConeDegrees / 2;

void check(bool possible, const char* what, double value, const char* hint) {
  if (!possible) throw Error(ErrorCode::kUsage, fmt::format("a camera's {} cannot be {}", what, value), hint);
}

}  // namespace

Camera Camera::look(double azimuth_degrees, double elevation_degrees, double zoom, const Bounds& bounds,
                    double aspect, bool perspective) {
  std::array<Vec3, 8> corners;
  for (unsigned n = 0; n < 8; ++n) {
    corners[n] = {(n & 1U) != 0 ? bounds.hi.x : bounds.lo.x, (n & 2U) != 0 ? bounds.hi.y : bounds.lo.y,
                  (n & 4U) != 0 ? bounds.hi.z : bounds.lo.z};
  }
  return look(azimuth_degrees, elevation_degrees, zoom, corners, aspect, perspective);
}

Camera Camera::look(double azimuth_degrees, double elevation_degrees, double zoom,
                    std::span<const Vec3> corners, double aspect, bool perspective) {
  check(std::isfinite(azimuth_degrees), "azimuth", azimuth_degrees, "give degrees; 0 looks north, 90 east");
  check(std::abs(elevation_degrees) <= 90, "elevation", elevation_degrees,
        "give -90 to 90 degrees above the horizon");
  check(zoom > 0 && std::isfinite(zoom), "zoom", zoom, "1 fits the survey's box, 2 is twice as large");
  check(aspect > 0 && std::isfinite(aspect), "width / height", aspect, "give a width and height above 0");

  const double azimuth = azimuth_degrees * std::numbers::pi / 180;
  const double elevation = elevation_degrees * std::numbers::pi / 180;
  Camera camera;
  camera.perspective = perspective;
  camera.forward = {std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation),
                    -std::sin(elevation)};
  camera.right = {std::cos(azimuth), -std::sin(azimuth), 0};
  camera.up = cross(camera.right, camera.forward);

  Vec3 centre;
  for (const Vec3& p : corners) centre = centre + p * (1.0 / static_cast<double>(corners.size()));
  double radius = 1e-6;
  for (const Vec3& p : corners) radius = std::max(radius, length(p - centre));
  const double distance = radius / std::sin(kHalfFieldDegrees * std::numbers::pi / 180);
  camera.eye = centre - camera.forward * distance;

  // Where the box lands without scale: its middle becomes the picture's, its size the scale.
  double least[2] = {INFINITY, INFINITY};
  double most[2] = {-INFINITY, -INFINITY};
  for (const Vec3& p : corners) {
    const Vec3 from_eye = p - camera.eye;
    const double along = perspective ? dot(from_eye, camera.forward) : 1;
    const double at[2] = {dot(from_eye, camera.right) / along, dot(from_eye, camera.up) / along};
    for (int axis = 0; axis < 2; ++axis) {
      least[axis] = std::min(least[axis], at[axis]);
      most[axis] = std::max(most[axis], at[axis]);
    }
  }
  const double half_width = std::max((most[0] - least[0]) / 2, 1e-12);
  const double half_height = std::max((most[1] - least[1]) / 2, 1e-12);
  const double scale = kFill * zoom * std::min(aspect / half_width, 1 / half_height);
  const double middle[2] = {(least[0] + most[0]) / 2, (least[1] + most[1]) / 2};

  // The depth range has room for surfaces that stick out of the box.
  camera.set_projection(
      {scale, aspect, {middle[0], middle[1]}, distance - 2 * radius, distance + 3 * radius});
  return camera;
}

Camera Camera::look_at(const Vec3& eye, const Vec3& target, const Vec3& up, std::span<const Vec3> corners,
                       double aspect, bool perspective) {
  check(aspect > 0 && std::isfinite(aspect), "width / height", aspect, "give a width and height above 0");
  const Vec3 view = target - eye;
  const double far = length(view);
  const Vec3 across = cross(view, up);
  const double size = length(across);
  if (!std::isfinite(far) || !std::isfinite(size) || !(far > 0) || !(size > 1e-9 * far * length(up))) {
    throw Error(ErrorCode::kUsage, "a camera cannot look there",
                "eye and target are two places in metres, and up must not lie along the view");
  }
  Camera camera;
  camera.perspective = perspective;
  camera.forward = view * (1 / far);
  camera.right = across * (1 / size);
  camera.up = cross(camera.right, camera.forward);
  camera.eye = eye;
  const double half = std::tan(kHalfFieldDegrees * std::numbers::pi / 180);
  const double scale = 1 / (perspective ? half : half * far) * std::min(1.0, aspect);
  double nearest = INFINITY;
  double farthest = far;
  double size_of_box = 1e-6;
  for (const Vec3& p : corners) {
    const double along = dot(p - eye, camera.forward);
    nearest = std::min(nearest, along);
    farthest = std::max(farthest, along);
    size_of_box = std::max(size_of_box, length(p - corners.front()));
  }
  farthest += size_of_box;
  nearest -= size_of_box / 2;
  // In perspective the depth's precision near the far end is lost when the range begins too near the eye.
  if (perspective) nearest = std::max(nearest, farthest * 1e-3);
  camera.set_projection({scale, aspect, {0, 0}, nearest, farthest});
  return camera;
}

void Camera::set_projection(const Projection& how) {
  Camera& camera = *this;
  const auto& [scale, aspect, middle, nearest, farthest] = how;
  const auto row = [&](const Vec3& axis, double constant, int at) {
    const std::array<double, 4> values{axis.x, axis.y, axis.z, constant - dot(axis, camera.eye)};
    std::copy(values.begin(), values.end(), camera.view_projection.begin() + 4 * at);
  };
  if (perspective) {
    row((camera.right - camera.forward * middle[0]) * (scale / aspect), 0, 0);
    row((camera.up - camera.forward * middle[1]) * scale, 0, 1);
    row(camera.forward * ((farthest + nearest) / (farthest - nearest)),
        -2 * farthest * nearest / (farthest - nearest), 2);
    row(camera.forward, 0, 3);
  } else {
    row(camera.right * (scale / aspect), -middle[0] * scale / aspect, 0);
    row(camera.up * scale, -middle[1] * scale, 1);
    row(camera.forward * (2 / (farthest - nearest)), -(farthest + nearest) / (farthest - nearest), 2);
    row({0, 0, 0}, 1, 3);
  }
}

Camera Camera::within(double x0, double x1, double y0, double y1) const {
  Camera part = *this;
  for (std::size_t n = 0; n < 4; ++n) {
    const double w = view_projection[12 + n];
    part.view_projection[n] = view_projection[n] * (x1 - x0) + w * (x0 + x1 - 1);
    part.view_projection[4 + n] = view_projection[4 + n] * (y1 - y0) + w * (1 - y0 - y1);
  }
  return part;
}

Vec3 Camera::towards_eye(const Vec3& p) const {
  if (!perspective) return forward * -1;
  const Vec3 d = eye - p;
  const double far = length(d);
  return far > 0 ? d * (1 / far) : forward * -1;
}

}  // namespace footwall::render
