// A small survey with three faults and folded layers, made by formula: enough for the eye and for the tests.
#pragma once
#include <cmath>
#include <string>

#include "engine/render/fault_picture.h"

namespace footwall::render::sample {

inline survey::Geometry geometry() {
  survey::Geometry g;
  g.inlines = {300, 1, 251};
  g.crosslines = {600, 1, 251};
  g.samples = 251;
  g.z0 = 1000;
  g.interval = 2;
  g.map = {606000, 6084000, -3.5, 24.7, 24.7, 3.5};
  return g;
}

// A surface j(i, k) over the survey, with `steps` quads each way.
template <class Crossline>
FaultMesh fault(const std::string& name, double i0, double i1, double k0, double k1, int steps,
                Crossline crossline) {
  const survey::Geometry g = geometry();
  FaultMesh mesh;
  mesh.name = name;
  for (int a = 0; a <= steps; ++a) {
    for (int b = 0; b <= steps; ++b) {
      const double i = i0 + (i1 - i0) * a / steps;
      const double k = k0 + (k1 - k0) * b / steps;
      mesh.vertices.push_back(g.world_of({i, crossline(i, k), k}));
    }
  }
  for (std::int32_t a = 0; a < steps; ++a) {
    for (std::int32_t b = 0; b < steps; ++b) {
      const std::int32_t v = a * (steps + 1) + b;
      const std::int32_t w = v + steps + 1;
      mesh.triangles.push_back({v, w, v + 1});
      mesh.triangles.push_back({w, w + 1, v + 1});
    }
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const double x = static_cast<double>(t) / static_cast<double>(mesh.triangles.size());
    const double y = static_cast<double>(t % static_cast<std::size_t>(2 * steps)) / (2 * steps);
    const double noise = std::sin(static_cast<double>(t * 7919 % 1000));
    mesh.values.push_back(0.05 + 0.35 * std::exp(-8 * ((x - 0.6) * (x - 0.6) + (y - 0.55) * (y - 0.55))) +
                          0.03 * noise * noise);
  }
  return mesh;
}

inline float amplitude(double i, double j, double k) {
  const double shift = 10 * std::sin(i / 60) + 8 * std::cos(j / 45 + i / 90) + (j > 80 + k * 0.25 ? 14 : 0);
  const double z = k + shift;
  return static_cast<float>(std::sin(z / 3.1) * (0.6 + 0.4 * std::sin(z / 11.3)) + 0.5 * std::sin(z / 7.7));
}

inline ShownSection section(int axis, std::int64_t index) {
  const survey::Index dims = geometry().dims();
  ShownSection made{axis, index, {}};
  for (std::int64_t i = 0; i < dims[0]; ++i) {
    for (std::int64_t j = 0; j < dims[1]; ++j) {
      for (std::int64_t k = 0; k < dims[2]; ++k) {
        if ((axis == 0 ? i : axis == 1 ? j : k) != index) continue;
        made.values.push_back(
            amplitude(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
      }
    }
  }
  return made;
}

inline FaultPicture scene() {
  FaultPicture what;
  what.geometry = geometry();
  what.title = "demo.footwall";
  what.statistic.unit = "unit²";
  what.faults.push_back(
      fault("F1 main", 20, 200, 20, 230, 18, [](double i, double k) { return 70 + k * 0.25 + i * 0.1; }));
  what.faults.push_back(fault("F2 listric", 40, 240, 10, 200, 20, [](double i, double k) {
    return 130 + 30 * std::sin(i / 90) + k * k * 0.0018;
  }));
  what.faults.push_back(fault("F3 twisted", 60, 230, 60, 245, 14, [](double i, double k) {
    return 215 + 0.12 * (i - 125) * (k - 125) / 125 - k * 0.12;
  }));
  for (std::size_t t = 0; t < 40; ++t) what.faults[2].values[t] = NAN;
  what.sections.push_back(section(0, 245));
  return what;
}

}  // namespace footwall::render::sample
