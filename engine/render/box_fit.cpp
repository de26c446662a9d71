#include "engine/render/box_fit.h"

#include <algorithm>
#include <cmath>

#include "engine/render/axes.h"

namespace footwall::render {
namespace {

constexpr int kRounds = 3;                // the labels' distance from the box hardly depends on its size
constexpr double kMostForLabels = 0.35;   // of the room, on each side
constexpr double kWidthOfALetter = 0.62;  // of its size

struct Span {
  double lo = INFINITY;
  double hi = -INFINITY;
  void add(double v) {
    lo = std::min(lo, v);
    hi = std::max(hi, v);
  }
};

struct Outline {
  Span x;
  Span y;
};

Outline outline_of(std::span<const Vec3> points, const Camera& camera, int width, int height) {
  Outline all;
  for (const Vec3& p : points) {
    const Vec4 clip = camera.clip_of(p);
    all.x.add((clip.x / clip.w * 0.5 + 0.5) * width);
    all.y.add((0.5 - clip.y / clip.w * 0.5) * height);
  }
  return all;
}

Outline outline_of(const Label& label, const Camera& camera, int width, int height) {
  const Outline at = outline_of(std::span(label.anchors).first(1), camera, width, height);
  const auto letters = std::count_if(label.text.begin(), label.text.end(),
                                     [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; });
  const double across = kWidthOfALetter * label.size * static_cast<double>(letters);
  const double share = label.align == Align::kLeft ? 0 : label.align == Align::kCentre ? 0.5 : 1;
  const double left = at.x.lo + label.shift_x - share * across;
  const double middle = at.y.lo + label.shift_y;
  return {{left, left + across}, {middle - 0.65 * label.size, middle + 0.65 * label.size}};
}

// The whole box, into the room and no farther.
Camera filling(const SceneFrame& frame, const Direction& direction, double zoom, const Room& room, int width,
               int height) {
  const std::array<Vec3, 8> corners = frame.corners();
  const double across = room.x1 - room.x0;
  const double down = room.y1 - room.y0;
  // look() leaves a rim; the part of the picture given to it is larger by as much.
  const double rim = (1 / Camera::kFill - 1) / 2;
  return Camera::look(direction.azimuth_degrees, direction.elevation_degrees, zoom, corners, across / down,
                      direction.perspective)
      .within((room.x0 - rim * across) / width, (room.x1 + rim * across) / width,
              (room.y0 - rim * down) / height, (room.y1 + rim * down) / height);
}

}  // namespace

Camera fitted_camera(const SceneFrame& frame, const Direction& direction, double zoom, const Room& room,
                     int width, int height, double text_scale) {
  const std::array<Vec3, 8> corners = frame.corners();
  Room left = room;
  for (int round = 0; round < kRounds; ++round) {
    const Camera camera = filling(frame, direction, 1, left, width, height);
    Scene axes;
    axes.text_scale = text_scale;
    add_axes(axes, frame, camera, width, height);
    const Outline box = outline_of(corners, camera, width, height);
    Outline all = box;
    for (const Label& label : axes.labels) {
      const Outline text = outline_of(label, camera, width, height);
      for (const double x : {text.x.lo, text.x.hi}) all.x.add(x);
      for (const double y : {text.y.lo, text.y.hi}) all.y.add(y);
    }
    const double most_x = kMostForLabels * (room.x1 - room.x0);
    const double most_y = kMostForLabels * (room.y1 - room.y0);
    left = {room.x0 + std::min(box.x.lo - all.x.lo, most_x), room.y0 + std::min(box.y.lo - all.y.lo, most_y),
            room.x1 - std::min(all.x.hi - box.x.hi, most_x), room.y1 - std::min(all.y.hi - box.y.hi, most_y)};
  }
  return filling(frame, direction, zoom, left, width, height);
}

}  // namespace footwall::render
