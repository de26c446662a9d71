// The scene's camera as the mouse moves it: around a target, with a direction and a distance. Scene metres
// (engine/render/scene_frame.h); azimuth 0 looks north, 90 east; elevation is the eye's height above the
// horizon.
#pragma once
#include <QPointF>
#include <QSizeF>
#include <array>
#include <span>

#include "engine/render/camera.h"

namespace footwall::ui {

enum class StandardView { kTop, kBottom, kNorth, kEast, kSouth, kWest, kOblique };  // looking that way

struct Ray {
  render::Vec3 from;
  render::Vec3 along;  // a unit vector
};

class OrbitCamera {
 public:
  // The corners of what may be seen: the depth range's and what fit() shows.
  void set_corners(const std::array<render::Vec3, 8>& corners) { corners_ = corners; }
  // Whole corners, or those given, as large as the view has room for, from the present direction.
  void fit(const QSizeF& view);
  void fit(const QSizeF& view, std::span<const render::Vec3> corners);
  void look(StandardView view);
  // Oblique to a box whose sides run along this azimuth, the north-west ahead as far as that goes.
  void look_along(double side_degrees);
  void set_direction(double azimuth_degrees, double elevation_degrees);
  void set_perspective(bool on) { perspective_ = on; }
  bool perspective() const { return perspective_; }
  double azimuth() const { return azimuth_; }
  double elevation() const { return elevation_; }
  const render::Vec3& target() const { return target_; }
  render::Vec3 eye() const;
  render::Vec3 up() const;
  // False, and no change, for what no camera can be.
  bool place(const render::Vec3& eye, const render::Vec3& target);

  // By pixels of the mouse.
  void orbit(double right, double down);
  void pan(double right, double down, const QSizeF& view);
  // The distance to `at` times factor: what is seen at it stays where it is.
  void zoom(double factor, const render::Vec3& at);
  // Heights were stretched by factor.
  void stretch(double factor);

  render::Camera camera(const QSizeF& view) const;
  Ray ray(const QPointF& pixel, const QSizeF& view) const;
  // Metres that a pixel spans at the target.
  double metres_per_pixel(const QSizeF& view) const;

 private:
  render::Vec3 forward() const;

  std::array<render::Vec3, 8> corners_{};
  render::Vec3 target_;
  double azimuth_ = 315;
  double elevation_ = 28;
  double distance_ = 1;
  bool perspective_ = true;
};

// Pixels from the view's upper left corner, and the depth beyond them (clip z / w); false behind the eye.
bool project_to(const render::Camera& camera, const QSizeF& view, const render::Vec3& place, QPointF* pixel,
                double* depth = nullptr);

}  // namespace footwall::ui
