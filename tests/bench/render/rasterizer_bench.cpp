// How fast the rasterizer draws triangles of a given size, one thread: bench_render [repeats]
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <random>
#include <vector>

#include "engine/render/rasterizer.h"

namespace {

using namespace footwall::render;
constexpr int kWidth = 1920;
constexpr int kHeight = 1080;

struct Case {
  std::vector<ScreenVertex> vertices;
  std::vector<TriangleIndices> triangles;
};

// Quads of two triangles of `area` pixels each, over and over the picture, in the order of a mesh, jittered.
Case case_of(double area, std::size_t count) {
  Case made;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> jitter(-0.2, 0.2);
  const double side = std::sqrt(2 * area);
  const int columns = std::max(1, static_cast<int>((kWidth - 2 * side) / side));
  const int rows = std::max(1, static_cast<int>((kHeight - 2 * side) / side));
  while (made.triangles.size() < count) {
    const auto first = static_cast<std::int32_t>(made.vertices.size());
    for (int y = 0; y <= rows; ++y) {
      for (int x = 0; x <= columns; ++x) {
        made.vertices.push_back({static_cast<std::int32_t>((x + 0.5 + jitter(random)) * side * kSubPixels),
                                 static_cast<std::int32_t>((y + 0.5 + jitter(random)) * side * kSubPixels),
                                 static_cast<float>(0.5 + jitter(random)), 0});
      }
    }
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) {
        const std::int32_t v = first + y * (columns + 1) + x;
        made.triangles.push_back({v, v + 1, v + columns + 1});
        made.triangles.push_back({v + 1, v + columns + 2, v + columns + 1});
      }
    }
  }
  return made;
}

}  // namespace

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::max(1, std::atoi(argv[1])) : 7;
  fmt::print("{:>10} {:>12} {:>10} {:>10} {:>10}\n", "px/tri", "triangles", "Mtri/s", "spread", "Mpix/s");
  for (const double area : {0.5, 2.0, 8.0, 64.0, 1024.0, 8192.0}) {
    const Case drawn = case_of(area, area < 100 ? 2'000'000 : 20'000);
    VisibilityBuffer buffer(kWidth, kHeight);
    std::vector<double> seconds;
    for (int n = 0; n < repeats; ++n) {
      buffer.clear();
      const auto start = std::chrono::steady_clock::now();
      rasterize({}, {}, drawn.vertices, drawn.triangles, 0, buffer);
      seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    // The answer first: the meshes cover the inner picture without a hole.
    const int border = static_cast<int>(4 * std::sqrt(2 * area));
    for (int y = border; y < kHeight - border; ++y) {
      for (int x = border; x < kWidth - border; ++x) {
        if (buffer.at(x, y) == kBackground) {
          fmt::print(stderr, "pixel {},{} was missed at {} px\n", x, y, area);
          return 1;
        }
      }
    }
    std::sort(seconds.begin(), seconds.end());
    const double median = seconds[seconds.size() / 2];
    const double rate = static_cast<double>(drawn.triangles.size()) / median / 1e6;
    fmt::print("{:>10} {:>12} {:>10.1f} {:>9.0f}% {:>10.0f}\n", area, drawn.triangles.size(), rate,
               100 * (seconds.back() - seconds.front()) / median, rate * area);
  }
}
