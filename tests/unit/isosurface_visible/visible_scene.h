// Scenes for pictures of only what can be seen, and those of the whole surface to compare them with.
#pragma once
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "engine/isosurface/brick_ranges.h"
#include "engine/isosurface/visible/visible_drawing.h"
#include "engine/verify/visible_by_definition.h"
#include "unit/isosurface/sample_volumes.h"

namespace footwall::isosurface {

inline constexpr int kWidth = 150;
inline constexpr int kHeight = 130;
inline constexpr render::Rgba kColour = render::hex(0xc08040);

struct VisibleScene {
  explicit VisibleScene(SampleVolume made)
      : volume(std::move(made)), ranges(brick_ranges(volume.field(), 1)), parts{{volume.field(), {}}} {
    parts.front().bricks.hi = ranges.dims;
    request.volume_size = volume.size;
    request.bricks = ranges.tables();
    request.colour = kColour;
    request.width = kWidth;
    request.height = kHeight;
  }
  VisibleScene(const VisibleScene&) = delete;
  VisibleScene& operator=(const VisibleScene&) = delete;

  std::vector<render::Vec3> corners() const {
    std::vector<render::Vec3> all;
    for (unsigned n = 0; n < 8; ++n) {
      all.push_back(request.placement({(n & 1U) != 0 ? static_cast<double>(volume.size[0]) - 1 : 0.0,
                                       (n & 2U) != 0 ? static_cast<double>(volume.size[1]) - 1 : 0.0,
                                       (n & 4U) != 0 ? static_cast<double>(volume.size[2]) - 1 : 0.0}));
    }
    return all;
  }
  void look(double azimuth, double elevation, double zoom, bool perspective) {
    request.camera = render::Camera::look(azimuth, elevation, zoom, corners(),
                                          static_cast<double>(request.width) / request.height, perspective);
  }
  void look_from(const render::Vec3& eye, const render::Vec3& target, bool perspective) {
    request.camera =
        render::Camera::look_at(request.placement(eye), request.placement(target), {0.1, 0.2, 1}, corners(),
                                static_cast<double>(request.width) / request.height, perspective);
  }
  // From anywhere around, or inside.
  void look_at_random(std::mt19937& random) {
    std::uniform_real_distribution<double> share(0, 1);
    const bool perspective = random() % 2 == 0;
    if (random() % 3 == 0) {
      const auto anywhere = [&] {
        return render::Vec3{share(random) * static_cast<double>(volume.size[0]),
                            share(random) * static_cast<double>(volume.size[1]),
                            share(random) * static_cast<double>(volume.size[2])};
      };
      const render::Vec3 eye = anywhere();
      look_from(eye, anywhere(), perspective);
      return;
    }
    const double azimuth = share(random) * 360;
    const double elevation = share(random) * 180 - 90;
    const double near = share(random);
    look(azimuth, elevation, 0.3 + 4 * near * near, perspective);
  }
  verify::SurfacePicture whole() const {
    return verify::whole_surface_picture(volume.field(), request.isovalue, request.camera, request.placement,
                                         kColour, request.width, request.height);
  }
  // Draws with `drawing`; "" where the picture is that of the whole surface.
  std::string difference(VisibleDrawing& drawing, VisibleReport& report) {
    OneRank alone;
    report = drawing.draw(alone, parts, request);
    std::vector<render::Rgba> colours(drawing.window().pixels().size());
    drawing.frame().shade(drawing.window(), colours, 1);
    return verify::difference(whole(), drawing.window(), colours);
  }
  std::string difference() {
    VisibleDrawing drawing;
    VisibleReport report;
    return difference(drawing, report);
  }

  SampleVolume volume;
  BrickRanges ranges;
  std::vector<VolumePart> parts;
  VisibleRequest request;
};

inline SampleVolume gyroid(const survey::Index& size, double turns) {
  return sampled(size, [&](auto i, auto j, auto k) {
    const double s = turns * 2 * std::numbers::pi / static_cast<double>(size[0]);
    const double x = s * static_cast<double>(i);
    const double y = s * static_cast<double>(j);
    const double z = s * static_cast<double>(k);
    return std::sin(x) * std::cos(y) + std::sin(y) * std::cos(z) + std::sin(z) * std::cos(x);
  });
}

}  // namespace footwall::isosurface
