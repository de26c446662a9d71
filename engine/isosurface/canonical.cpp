#include "engine/isosurface/canonical.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <numeric>
#include <vector>

#include "engine/isosurface/cap.h"
#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

constexpr const char* kAxisNames[] = {"i edge", "j edge", "k edge", "centre"};

bool same_bits(const Point& a, const Point& b) {
  const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };
  return bits(a.i) == bits(b.i) && bits(a.j) == bits(b.j) && bits(a.k) == bits(b.k);
}

std::string words(const Point& p) {
  return fmt::format("({:.9g}, {:.9g}, {:.9g})", p.i, p.j, p.k);
}

std::string words(const Triangle& t) {
  return fmt::format("({}, {}, {})", t[0], t[1], t[2]);
}

std::string words(VertexKey key, const survey::Index& volume_size) {
  if ((key & kSampleKey) != 0) {
    const KeyPlace place = place_of(4 * (key & ~kSampleKey), volume_size);
    return fmt::format("the sample ({}, {}, {})", place.sample[0], place.sample[1], place.sample[2]);
  }
  const KeyPlace place = place_of(key, volume_size);
  return fmt::format("the {} of ({}, {}, {})", kAxisNames[place.axis], place.sample[0], place.sample[1],
                     place.sample[2]);
}

Triangle from_smallest(const Triangle& t) {
  if (t[0] <= t[1] && t[0] <= t[2]) return t;
  if (t[1] <= t[0] && t[1] <= t[2]) return {t[1], t[2], t[0]};
  return {t[2], t[0], t[1]};
}

}  // namespace

KeyPlace place_of(VertexKey key, const survey::Index& volume_size) {
  const auto sample = static_cast<std::int64_t>(key >> 2);
  const std::int64_t row = sample / volume_size[2];
  return {{row / volume_size[1], row % volume_size[1], sample % volume_size[2]}, static_cast<int>(key & 3)};
}

VertexKey key_of(const survey::Index& sample, int axis, const survey::Index& volume_size) {
  return 4 * static_cast<VertexKey>((sample[0] * volume_size[1] + sample[1]) * volume_size[2] + sample[2]) +
         static_cast<VertexKey>(axis);
}

Surface canonical(const Surface& surface) {
  const std::size_t vertices = surface.positions.size();
  if (surface.keys.size() != vertices) {
    throw Error(ErrorCode::kInvalid, "a surface without keys has no canonical form", "extract it with keys");
  }
  std::vector<std::uint32_t> order(vertices);
  std::iota(order.begin(), order.end(), std::uint32_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return surface.keys[a] < surface.keys[b]; });
  Surface form;
  form.cells = surface.cells;
  form.positions.resize_uninitialised(vertices);
  form.keys.resize_uninitialised(vertices);
  if (!surface.normals.empty()) form.normals.resize_uninitialised(vertices);
  std::vector<std::uint32_t> number(vertices);
  for (std::uint32_t n = 0; n < vertices; ++n) {
    const std::uint32_t from = order[n];
    if (n > 0 && surface.keys[from] == form.keys[n - 1]) {
      throw Error(ErrorCode::kInvalid,
                  fmt::format("two vertices of a surface have the key {}", form.keys[n - 1]));
    }
    number[from] = n;
    form.positions[n] = surface.positions[from];
    form.keys[n] = surface.keys[from];
    if (!surface.normals.empty()) form.normals[n] = surface.normals[from];
  }
  form.triangles.resize_uninitialised(surface.triangles.size());
  for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
    const Triangle& t = surface.triangles[n];
    form.triangles[n] = from_smallest({number[t[0]], number[t[1]], number[t[2]]});
  }
  const auto all = form.triangles.all();
  std::sort(all.begin(), all.end());
  return form;
}

std::optional<std::string> difference(const Surface& here, const Surface& there,
                                      const survey::Index& volume_size) {
  const auto counts = [](const char* what, std::size_t a, std::size_t b) {
    return fmt::format("{} {} here, {} there", a, what, b);
  };
  const bool keys = !here.keys.empty() && !there.keys.empty();
  const std::size_t shared = std::min(here.positions.size(), there.positions.size());
  for (std::size_t n = 0; keys && n < shared; ++n) {
    if (here.keys[n] == there.keys[n]) continue;
    return fmt::format("vertex {} is on {} here and on {} there", n, words(here.keys[n], volume_size),
                       words(there.keys[n], volume_size));
  }
  if (here.positions.size() != there.positions.size()) {
    return counts("vertices", here.positions.size(), there.positions.size());
  }
  if (here.normals.size() != there.normals.size()) {
    return counts("normals", here.normals.size(), there.normals.size());
  }
  const auto place = [&](std::size_t n) {
    return keys ? ", on " + words(here.keys[n], volume_size) + "," : std::string();
  };
  for (std::size_t n = 0; n < here.positions.size(); ++n) {
    if (!same_bits(here.positions[n], there.positions[n])) {
      return fmt::format("vertex {}{} is at {} here and at {} there", n, place(n), words(here.positions[n]),
                         words(there.positions[n]));
    }
  }
  for (std::size_t n = 0; n < here.normals.size(); ++n) {
    if (!same_bits(here.normals[n], there.normals[n])) {
      return fmt::format("the normal of vertex {}{} is {} here and {} there", n, place(n),
                         words(here.normals[n]), words(there.normals[n]));
    }
  }
  const std::size_t triangles = std::min(here.triangles.size(), there.triangles.size());
  for (std::size_t n = 0; n < triangles; ++n) {
    if (here.triangles[n] == there.triangles[n]) continue;
    return fmt::format("triangle {} is {} here and {} there", n, words(here.triangles[n]),
                       words(there.triangles[n]));
  }
  if (here.triangles.size() != there.triangles.size()) {
    return counts("triangles", here.triangles.size(), there.triangles.size());
  }
  return std::nullopt;
}

std::optional<std::string> difference_but_for_order(const Surface& here, const Surface& there,
                                                    const survey::Index& volume_size) {
  return difference(canonical(here), canonical(there), volume_size);
}

}  // namespace footwall::isosurface
