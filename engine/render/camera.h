// From the scene frame to the picture. Conventions: azimuth 0 looks north, 90 looks east; elevation is the
// camera's height above the horizon; zoom 1 fits the box.
#pragma once
#include <span>

#include "engine/render/vector.h"

namespace footwall::render {

struct Camera {
  Matrix4 view_projection{};  // scene metres -> OpenGL clip space, row major
  Vec3 eye;    // perspective: the centre of projection; parallel: a point far behind the picture
  Vec3 right;  // unit vectors of the picture in the scene frame
  Vec3 up;
  Vec3 forward;
  bool perspective = true;

  // Looks at the box. Whatever the direction, the box's picture is centred and at zoom 1 takes kFill of the
  // width or height; the depth range holds the box. Throws Error kUsage for values that are not finite, zoom
  // or aspect (width / height) <= 0, elevation outside [-90, 90].
  static Camera look(double azimuth_degrees, double elevation_degrees, double zoom, const Bounds& bounds,
                     double aspect, bool perspective);
  // The same around the corners of a box that is turned against the axes: closer than around its bounds.
  static Camera look(double azimuth_degrees, double elevation_degrees, double zoom,
                     std::span<const Vec3> corners, double aspect, bool perspective);
  static constexpr double kFill = 0.86;
  // From `eye` to `target`, scene metres; `up` comes out upwards. In perspective a cone of kConeDegrees fills
  // the lesser of width and height; parallel, what that cone takes in at the target. The depth range holds
  // what lies before the eye of the corners' box. Throws Error kUsage for numbers that are not finite, an eye
  // at the target, or an `up` along the view.
  static Camera look_at(const Vec3& eye, const Vec3& target, const Vec3& up, std::span<const Vec3> corners,
                        double aspect, bool perspective);
  static constexpr double kConeDegrees = 28;

  // The same view drawn into a part of the picture: x 0..1 from the left, y 0..1 from the top.
  Camera within(double x0, double x1, double y0, double y1) const;

  Vec4 clip_of(const Vec3& p) const { return transformed(view_projection, p); }
  // From p towards the camera, a unit vector.
  Vec3 towards_eye(const Vec3& p) const;

 private:
  struct Projection {
    double scale;
    double aspect;
    std::array<double, 2> middle;  // what comes to the picture's middle, right and up, before the scale
    double nearest;                // of the depth range, metres before the eye
    double farthest;
  };
  void set_projection(const Projection& how);
};

}  // namespace footwall::render
