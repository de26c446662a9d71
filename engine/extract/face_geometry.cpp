#include "engine/extract/face_geometry.h"

#include <array>
#include <cmath>

#include "storage/base/error.h"

namespace footwall::extract {
namespace {

using Vector = std::array<double, 3>;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double length(const Vector& a) {
  return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

constexpr double kPi = 3.14159265358979323846;

// atan(t) for 0 <= t <= 1 from + - * / sqrt alone, to about 1e-15: the angle is halved twice, to at most
// pi/16, and its series summed.
double arc_tangent(double t) {
  t = t / (1 + std::sqrt(1 + t * t));
  t = t / (1 + std::sqrt(1 + t * t));
  const double square = t * t;
  double series = 0;
  for (int n = 23; n >= 1; n -= 2) series = 1.0 / n - square * series;
  return 4 * t * series;
}

// The angle of (x, y) from the x axis, in degrees, 0 <= angle < 360.
double angle_degrees(double x, double y) {
  const double ax = std::abs(x);
  const double ay = std::abs(y);
  double angle = ay <= ax ? arc_tangent(ay / ax) * (180 / kPi) : 90 - arc_tangent(ax / ay) * (180 / kPi);
  if (x < 0) angle = 180 - angle;
  if (y < 0) angle = 360 - angle;
  return angle < 360 ? angle : 0;
}

}  // namespace

FaceGeometry face_geometry(const survey::Geometry& geometry, const survey::LatticeTriangle& triangle,
                           std::optional<double> velocity) {
  if (velocity && !(*velocity > 0 && std::isfinite(*velocity))) {
    throw Error(ErrorCode::kInvalid, "the velocity must be a positive number of metres per second");
  }
  // Edges in lattice units are whole numbers below 2^32: exact in double, and so is each of their
  // differences.
  Vector edges[2];
  for (int n = 0; n < 2; ++n) {
    const survey::LatticePoint& to = triangle[static_cast<std::size_t>(n) + 1];
    edges[n] = {static_cast<double>(to.i) - triangle[0].i, static_cast<double>(to.j) - triangle[0].j,
                static_cast<double>(to.k) - triangle[0].k};
    for (double& component : edges[n]) component /= survey::kLatticePerVoxel;
  }
  FaceGeometry result;
  const Vector normal = cross(edges[0], edges[1]);
  const double twice_area = length(normal);
  result.area_voxels = twice_area / 2;
  const bool metric = geometry.has_metric_depth() || velocity.has_value();
  if (twice_area == 0) {
    if (metric) result.area = 0;
    return result;
  }
  result.normal_i = normal[0] / twice_area;
  result.normal_j = normal[1] / twice_area;
  result.normal_k = normal[2] / twice_area;

  // East, north and down, in metres; without a velocity the vertical is in samples, which leaves the azimuth
  // alone.
  const auto in_metres = [&](const Vector& voxels) -> Vector {
    const survey::MapView& map = geometry.map;
    const double east = map.per_inline_x * voxels[0] + map.per_crossline_x * voxels[1];
    const double north = map.per_inline_y * voxels[0] + map.per_crossline_y * voxels[1];
    const double down =
        metric ? geometry.vertical_metres(voxels[2] * geometry.interval, velocity.value_or(0)) : voxels[2];
    return {geometry.horizontal_metres(east), geometry.horizontal_metres(north), down};
  };
  for (Vector& edge : edges) edge = in_metres(edge);
  if (metric)
    result.metres_along_normal = length(in_metres({result.normal_i, result.normal_j, result.normal_k}));
  Vector world = cross(edges[0], edges[1]);
  const double world_length = length(world);
  if (world_length == 0) return result;
  if (world[2] > 0) {
    for (double& component : world) component = -component;
  }
  // world now points up (its "down" is not positive), and the ground falls away on the side it leans to.
  const double horizontal = std::sqrt(world[0] * world[0] + world[1] * world[1]);
  if (horizontal != 0) result.dip_azimuth = angle_degrees(world[1], world[0]);
  if (metric) {
    result.area = world_length / 2;
    result.dip = angle_degrees(-world[2], horizontal);
  }
  return result;
}

}  // namespace footwall::extract
