// A small volume whose every sample tells where it is, with a rotated map, negative line numbers and dead
// traces.
#pragma once
#include <functional>

#include "engine/tasks/add_volume.h"

namespace footwall::tasks {

inline float made_value(std::int64_t i, std::int64_t j, std::int64_t k) {
  return static_cast<float>(10000 * i + 100 * j + k);
}
inline bool made_live(std::int64_t i, std::int64_t j) {
  return (i + 2 * j) % 7 != 3;
}

// Inlines 100 to 118 by 2, crosslines -50 to -15 by 5, 12 samples from 1000 by 4 ms.
inline VolumeSource made_source(
    const std::function<float(std::int64_t, std::int64_t, std::int64_t)>& value = made_value) {
  VolumeSource source;
  survey::Geometry& g = source.geometry;
  g.inlines = {100, 2, 10};
  g.crosslines = {-50, 5, 8};
  g.samples = 12;
  g.z0 = 1000;
  g.interval = 4;
  g.map = {500000, 6700000, 15, 20, 16, -12};
  source.text = "made";
  source.provenance_json = R"({"importer":"made"})";
  source.fill = [value](const survey::Box& box, std::span<float> values, std::span<std::uint8_t> live) {
    std::size_t n = 0;
    std::size_t trace = 0;
    for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
      for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
        live[trace++] = made_live(i, j) ? 1 : 0;
        for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) values[n++] = value(i, j, k);
      }
    }
  };
  return source;
}

}  // namespace footwall::tasks
