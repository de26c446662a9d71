// Small lit surfaces for tests, made without a library's sines.
#pragma once
#include <cmath>
#include <vector>

#include "engine/render/lit_surface.h"

namespace footwall::render::sample {

inline constexpr Rgba kColour = hex(0xd08040);

// A ball of radius 0.9 with lumps: a cube's six faces of n x n squares, n = around / 4, blown up.
inline OwnedSurface ball(int around, PrimitiveId first_id) {
  OwnedSurface mesh;
  mesh.colour = kColour;
  const int n = std::max(1, around / 4);
  for (int face = 0; face < 6; ++face) {
    const auto first = static_cast<std::int32_t>(mesh.positions.size());
    const auto axis = static_cast<std::size_t>(face / 2);
    const float side = face % 2 == 0 ? -1.0F : 1.0F;
    for (int a = 0; a <= n; ++a) {
      for (int b = 0; b <= n; ++b) {
        float p[3];
        p[axis] = side;
        p[(axis + 1) % 3] = 2.0F * static_cast<float>(a) / static_cast<float>(n) - 1;
        p[(axis + 2) % 3] = 2.0F * static_cast<float>(b) / static_cast<float>(n) - 1;
        const float size = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        const float lump = 0.75F + 0.15F * p[0] * p[1] * p[2];
        mesh.normals.emplace_back(p[0] / size, p[1] / size, p[2] / size);
        mesh.positions.emplace_back(lump * p[0] / size, lump * p[1] / size, lump * p[2] / size);
      }
    }
    for (int a = 0; a < n; ++a) {
      for (int b = 0; b < n; ++b) {
        const std::int32_t at = first + a * (n + 1) + b;
        TriangleIndices one{at, at + n + 1, at + 1};
        TriangleIndices other{at + 1, at + n + 1, at + n + 2};
        if (side < 0) {
          std::swap(one[1], one[2]);
          std::swap(other[1], other[2]);
        }
        mesh.triangles.push_back(one);
        mesh.triangles.push_back(other);
      }
    }
  }
  mesh.runs = {{0, first_id}};
  return mesh;
}

// A square of 100 x 100 at z = -0.2, in n x n squares; its normals tilt from south to north.
inline OwnedSurface floor(int n, PrimitiveId first_id) {
  OwnedSurface mesh;
  mesh.colour = kColour;
  for (int a = 0; a <= n; ++a) {
    for (int b = 0; b <= n; ++b) {
      const float x = 100.0F * static_cast<float>(a) / static_cast<float>(n) - 50;
      const float y = 100.0F * static_cast<float>(b) / static_cast<float>(n) - 50;
      mesh.positions.emplace_back(x, y, -0.2F);
      mesh.normals.emplace_back(0.0F, 0.0F, 1.0F);
    }
  }
  for (int a = 0; a < n; ++a) {
    for (int b = 0; b < n; ++b) {
      const std::int32_t at = a * (n + 1) + b;
      mesh.triangles.push_back({at, at + n + 1, at + 1});
      mesh.triangles.push_back({at + 1, at + n + 1, at + n + 2});
    }
  }
  mesh.runs = {{0, first_id}};
  return mesh;
}

// The triangles of every `of`-th block of `block`, with their numbers.
inline OwnedSurface every(const OwnedSurface& mesh, std::size_t of, std::size_t which, std::size_t block) {
  OwnedSurface part = mesh;
  part.triangles.clear();
  part.runs.clear();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (t / block % of != which) continue;
    const PrimitiveId id = mesh.runs.front().first_id + static_cast<PrimitiveId>(t);
    if (part.triangles.empty() || t % block == 0) part.runs.push_back({part.triangles.size(), id});
    part.triangles.push_back(mesh.triangles[t]);
  }
  return part;
}

}  // namespace footwall::render::sample
