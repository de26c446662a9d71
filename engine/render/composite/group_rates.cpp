#include "engine/render/composite/group_rates.h"

#include <time.h>

#include <algorithm>
#include <cmath>

#include "engine/render/composite/geometry_bytes.h"
#include "engine/render/surface_frame.h"
#include "engine/render/surface_layer.h"

namespace footwall::render {
namespace {

double thread_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

// The least of three times, as the first also gets memory.
template <class Work>
double seconds_of(const Work& work) {
  double least = INFINITY;
  for (int n = 0; n < 3; ++n) {
    const double start = thread_seconds();
    work();
    least = std::min(least, thread_seconds() - start);
  }
  return least;
}

// n x n squares over [-1, 1]^2, with waves.
OwnedSurface waves(int n) {
  OwnedSurface made;
  for (int a = 0; a <= n; ++a) {
    for (int b = 0; b <= n; ++b) {
      const float x = 2.0F * static_cast<float>(a) / static_cast<float>(n) - 1;
      const float y = 2.0F * static_cast<float>(b) / static_cast<float>(n) - 1;
      made.positions.emplace_back(x, y, 0.02F * static_cast<float>((a + b) % 7));
      made.normals.emplace_back(0.0F, 0.0F, 1.0F);
    }
  }
  for (int a = 0; a < n; ++a) {
    for (int b = 0; b < n; ++b) {
      const std::int32_t at = a * (n + 1) + b;
      made.triangles.push_back({at, at + n + 1, at + 1});
      made.triangles.push_back({at + 1, at + n + 1, at + n + 2});
    }
  }
  made.runs = {{0, 0}};
  return made;
}

// Where a vertex lands, in pixels.
struct Spot {
  double x = 0;
  double y = 0;
};

class Sampler {
 public:
  Sampler(const Camera& camera, int width, int height) : camera_(camera), width_(width), height_(height) {}

  void add(const LitSurface& surface, std::size_t triangle) {
    ++sampled_;
    const Matrix4 to_clip = surface.placement.then(camera_.view_projection);
    Spot at[3];
    for (std::size_t n = 0; n < 3; ++n) {
      const auto v = static_cast<std::size_t>(surface.triangles[triangle][n]);
      const auto clip = transformed(to_clip, Vec3(surface.positions[v]));
      if (!(clip.w > 0)) return;  // behind the eye
      at[n] = {(clip.x / clip.w + 1) / 2 * width_, (clip.y / clip.w + 1) / 2 * height_};
    }
    const double twice =
        (at[1].x - at[0].x) * (at[2].y - at[0].y) - (at[2].x - at[0].x) * (at[1].y - at[0].y);
    const double x = std::clamp((at[0].x + at[1].x + at[2].x) / 3, -1.0, width_ + 1.0);
    const double y = std::clamp((at[0].y + at[1].y + at[2].y) / 3, -1.0, height_ + 1.0);
    if (!std::isfinite(twice) || x < 0 || x > width_ || y < 0 || y > height_) return;
    area_ += std::abs(twice) / 2;
    lo_ = {std::min(lo_.x, x), std::min(lo_.y, y)};
    hi_ = {std::max(hi_.x, x), std::max(hi_.y, y)};
  }

  // No more than the rectangle around all, which holds for surfaces that cover themselves.
  std::int64_t pixels(std::size_t triangles) const {
    if (sampled_ == 0 || hi_.x < lo_.x) return 0;
    const double share = static_cast<double>(triangles) / static_cast<double>(sampled_);
    const double rectangle = std::max(1.0, hi_.x - lo_.x) * std::max(1.0, hi_.y - lo_.y);
    return static_cast<std::int64_t>(
        std::min({area_ * share, std::max(rectangle, area_), static_cast<double>(width_) * height_}));
  }

 private:
  const Camera& camera_;
  int width_;
  int height_;
  std::size_t sampled_ = 0;
  double area_ = 0;
  Spot lo_{INFINITY, INFINITY};
  Spot hi_{-INFINITY, -INFINITY};
};

}  // namespace

GroupRates measure_drawing() {
  constexpr int kPixels = 256;
  constexpr int kSquares = 100;
  const OwnedSurface made = waves(kSquares);
  const LitSurface surface = made.view();
  const std::span<const LitSurface> one(&surface, 1);
  const Camera camera = Camera::look(0, 90, 1, Bounds{{-1, -1, 0}, {1, 1, 0.12}}, 1, false);
  SurfaceFrame frame;
  VisibilityBuffer window(kPixels, kPixels);
  std::vector<Rgba> colours(window.pixels().size());
  const auto all = static_cast<double>(colours.size());
  comm::Bytes part;
  GroupRates rates;

  frame.project(one, camera, kPixels, kPixels, 1);
  const auto look_at_all = [&] {
    window.clear();
    frame.shade(window, colours, 1);
    part.clear();
    encode_pixels(window, colours, 0, kPixels, PixelKind::kVisible, part);
  };
  rates.background = seconds_of(look_at_all) / all;
  const auto draw_into = [&](VisibilityBuffer& rows) {
    return seconds_of([&] {
             rows.clear();
             frame.project(one, camera, kPixels, kPixels, 1);
             frame.rasterize(rows, 1);
           }) /
           static_cast<double>(made.triangles.size());
  };
  VisibilityBuffer last_row(kPixels, kPixels, kPixels - 1, 1);
  rates.triangle = draw_into(last_row);
  rates.drawn = std::max(0.0, draw_into(window) - rates.triangle);
  rates.shaded = seconds_of([&] { frame.shade(window, colours, 1); }) / all;
  std::size_t seen = 0;
  const double packed = seconds_of([&] {
    part.clear();
    seen = encode_pixels(window, colours, 0, kPixels, PixelKind::kVisible, part);
  });
  const double merged = seconds_of([&] { merge_pixels(part, window, colours); });
  rates.merged = (packed + merged) / static_cast<double>(std::max<std::size_t>(1, seen));
  // What arrives comes into memory that was never touched.
  const OwnedSurface large = waves(3 * kSquares);
  const LitSurface sent = large.view();
  const double start = thread_seconds();
  const std::vector<OwnedSurface> received = surfaces_from(bytes_of(std::span(&sent, 1)));
  rates.geometry_byte = (thread_seconds() - start) / static_cast<double>(size_of(std::span(&sent, 1)));
  return rates;
}

std::int64_t covered_pixels(std::span<const LitSurface> surfaces, const Camera& camera, int width,
                            int height) {
  constexpr std::size_t kSamples = 1024;
  std::size_t triangles = 0;
  for (const LitSurface& surface : surfaces) triangles += surface.triangles.size();
  const std::size_t step = std::max<std::size_t>(1, triangles / kSamples);
  Sampler sampler(camera, width, height);
  std::size_t next = step / 2;  // counted from the current surface's first
  for (const LitSurface& surface : surfaces) {
    for (; next < surface.triangles.size(); next += step) sampler.add(surface, next);
    next -= surface.triangles.size();
  }
  return sampler.pixels(triangles);
}

}  // namespace footwall::render
