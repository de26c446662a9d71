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

// What a mask without depth loses: before, in one brick, a sliver; behind it a plate that fills the same
// bricks' places in the picture; behind that a larger plate. Drawn with the sliver, the larger plate covers
// the pixels of the plate in the middle, of which nothing was drawn yet.
inline SampleVolume sliver_plate_plate() {
  const auto box = [](double i, double j, double k, double half, double middle_k, double half_k) {
    return std::min({half - std::abs(i - 12), half - std::abs(j - 12), half_k - std::abs(k - middle_k)});
  };
  return sampled({25, 25, 25}, [=](auto i, auto j, auto k) {
    const auto x = static_cast<double>(i);
    const auto y = static_cast<double>(j);
    const auto z = static_cast<double>(k);
    const double sliver = std::min({0.6 - std::abs(x - 9), 3.4 - std::abs(y - 12), 1.4 - std::abs(z - 4)});
    return std::max({sliver, box(x, y, z, 3.3, 12, 1.3), box(x, y, z, 10.2, 20, 1.3)});
  });
}

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
