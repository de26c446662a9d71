#include "engine/render/scene_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "storage/base/error.h"

namespace footwall::render {
namespace {

// Half of it is one metre in a millisecond: what is drawn while nobody has said a velocity.
constexpr double kVelocityOfOneMetrePerMillisecond = 2000;

survey::IndexPoint middle_of(const survey::Geometry& g) {
  return {static_cast<double>(g.inlines.count - 1) / 2, static_cast<double>(g.crosslines.count - 1) / 2,
          static_cast<double>(g.samples - 1) / 2};
}

}  // namespace

SceneFrame::SceneFrame(const survey::Geometry& geometry, double exaggeration, double velocity)
    : geometry_(geometry),
      exaggeration_(exaggeration),
      velocity_(velocity == 0 ? kVelocityOfOneMetrePerMillisecond : velocity) {
  geometry_.validate();
  if (!(exaggeration > 0) || !std::isfinite(exaggeration)) {
    throw Error(ErrorCode::kUsage, fmt::format("a vertical exaggeration of {} is not possible", exaggeration),
                "give a number above 0; 1 draws heights as they are");
  }
  if (!(velocity >= 0) || !std::isfinite(velocity)) {
    throw Error(ErrorCode::kUsage, fmt::format("a velocity of {} m/s is not possible", velocity),
                "give a number above 0 in metres per second");
  }
  centre_ = geometry_.world_of(middle_of(geometry_));
}

Vec3 SceneFrame::scene_of(const survey::WorldPoint& p) const {
  return {geometry_.horizontal_metres(p.x - centre_.x), geometry_.horizontal_metres(p.y - centre_.y),
          -exaggeration_ * geometry_.vertical_metres(p.z - centre_.z, velocity_)};
}

Vec3 SceneFrame::scene_of(const survey::IndexPoint& p) const {
  return scene_of(geometry_.world_of(p));
}

std::array<Vec3, 8> SceneFrame::corners() const {
  const survey::Index dims = geometry_.dims();
  std::array<Vec3, 8> all;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const auto end = [&](unsigned axis) {
      return (corner >> axis & 1U) != 0 ? static_cast<double>(dims[axis]) - 0.5 : -0.5;
    };
    all[corner] = scene_of(survey::IndexPoint{end(0), end(1), end(2)});
  }
  return all;
}

Bounds SceneFrame::bounds() const {
  const std::array<Vec3, 8> all = corners();
  Bounds box{all[0], all[0]};
  for (const Vec3& p : all) {
    box.lo = {std::min(box.lo.x, p.x), std::min(box.lo.y, p.y), std::min(box.lo.z, p.z)};
    box.hi = {std::max(box.hi.x, p.x), std::max(box.hi.y, p.y), std::max(box.hi.z, p.z)};
  }
  return box;
}

double SceneFrame::pleasing_exaggeration(const survey::Geometry& geometry, double velocity) {
  const std::array<Vec3, 8> all = SceneFrame(geometry, 1, velocity).corners();
  const double width = std::max(length(all[1] - all[0]), length(all[2] - all[0]));
  const double height = length(all[4] - all[0]);
  const double wanted = 0.6 * width / height;
  double best = 1;
  for (const double step : {1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 15.0, 20.0, 30.0, 50.0, 100.0}) {
    if (std::abs(std::log(step / wanted)) < std::abs(std::log(best / wanted))) best = step;
  }
  return best;
}

}  // namespace footwall::render
