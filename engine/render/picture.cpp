#include "engine/render/picture.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <exception>

#include "engine/render/overlay.h"
#include "engine/render/shading.h"
#include "storage/base/error.h"

namespace footwall::render {
namespace {

constexpr int kBandRows = 24;  // of the finished picture: a band's samples stay in the second-level cache

Rgba averaged(const std::array<Rgba, kSamples * kSamples>& samples) {
  unsigned sums[3] = {0, 0, 0};
  for (const Rgba c : samples) {
    sums[0] += red(c);
    sums[1] += green(c);
    sums[2] += blue(c);
  }
  constexpr unsigned kCount = kSamples * kSamples;
  return rgb((sums[0] + kCount / 2) / kCount, (sums[1] + kCount / 2) / kCount,
             (sums[2] + kCount / 2) / kCount);
}

// Rows of samples of what was drawn elsewhere, for one row of pixels.
class LayerRows {
 public:
  LayerRows(const SurfaceLayer* layer, int width)
      : layer_(layer),
        width_(static_cast<std::size_t>(width)),
        depths_(layer == nullptr ? 0 : kSamples * width_),
        colours_(depths_.size()) {}
  void read(int row) {
    for (std::size_t n = 0; layer_ != nullptr && n < kSamples; ++n) {
      layer_->row(row * kSamples + static_cast<int>(n), std::span(depths_).subspan(n * width_, width_),
                  std::span(colours_).subspan(n * width_, width_));
    }
  }
  // In sample (x, y) of the row of pixels; false where a sample of that depth is not behind it.
  bool hides(float depth, int x, int y) const { return layer_ != nullptr && depths_[at(x, y)] < depth; }
  float depth(int x, int y) const { return depths_[at(x, y)]; }
  Rgba colour(int x, int y) const { return colours_[at(x, y)]; }

 private:
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x);
  }

  const SurfaceLayer* layer_;
  std::size_t width_;
  std::vector<float> depths_;
  std::vector<Rgba> colours_;
};

void draw_band(const PreparedScene& prepared, const Scene& scene, const SurfaceLayer* surfaces, int first_row,
               int rows, Picture& picture) {
  LayerRows layer(surfaces, picture.width * kSamples);
  VisibilityBuffer window(picture.width * kSamples, picture.height * kSamples, first_row * kSamples,
                          rows * kSamples);
  prepared.rasterize_into(window);
  for (int y = first_row; y < first_row + rows; ++y) {
    layer.read(y);
    const Rgba background = mixed(scene.background_top, scene.background_bottom, (y + 0.5) / picture.height);
    for (int x = 0; x < picture.width; ++x) {
      std::array<Rgba, kSamples * kSamples> samples{};
      for (int n = 0; n < kSamples * kSamples; ++n) {
        const int sx = x * kSamples + n % kSamples;
        const int sy = y * kSamples + n / kSamples;
        const Visible here = window.at(sx, sy);
        const PrimitiveId id = primitive_of(here);
        samples[static_cast<std::size_t>(n)] = layer.hides(depth_of(here), sx, n / kSamples)
                                                   ? layer.colour(sx, n / kSamples)
                                               : id == kNoPrimitive ? background
                                                                    : prepared.colour_at(id, sx, sy);
      }
      const Rgba colour = averaged(samples);
      const std::size_t pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x);
      const std::uint8_t bytes[4] = {static_cast<std::uint8_t>(red(colour)),
                                     static_cast<std::uint8_t>(green(colour)),
                                     static_cast<std::uint8_t>(blue(colour)), 255};
      std::copy(bytes, bytes + 4, picture.rgba.begin() + static_cast<std::ptrdiff_t>(4 * pixel));
      const int middle = x * kSamples + kSamples / 2;
      const float depth = depth_of(window.at(middle, y * kSamples + kSamples / 2));
      picture.depth[pixel] =
          layer.hides(depth, middle, kSamples / 2) ? layer.depth(middle, kSamples / 2) : depth;
    }
  }
}

}  // namespace

Picture render(const Scene& scene, const Camera& camera, int width, int height, int threads,
               const SurfaceLayer* surfaces, const JobContext& job) {
  if (width < 1 || height < 1 || width > kLargestPicture || height > kLargestPicture) {
    throw Error(ErrorCode::kUsage, fmt::format("a picture of {} x {} pixels cannot be drawn", width, height),
                fmt::format("give 1 to {} pixels each way", kLargestPicture));
  }
  require(surfaces == nullptr ||
              (surfaces->width() == width * kSamples && surfaces->height() == height * kSamples),
          "surfaces drawn for the samples of this picture");
  const int workers = threads > 0 ? threads : omp_get_max_threads();
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  Picture picture{width, height, std::vector<std::uint8_t>(4 * pixels), std::vector<float>(pixels)};
  const PreparedScene prepared(scene, camera, {width * kSamples, height * kSamples, kSamples}, workers);
  std::exception_ptr failure;  // an exception must not leave a parallel region; memory can run out in there
#pragma omp parallel for schedule(dynamic) num_threads(workers)
  for (int first = 0; first < height; first += kBandRows) {
    try {
      job.check();
      draw_band(prepared, scene, surfaces, first, std::min(kBandRows, height - first), picture);
    } catch (...) {
#pragma omp critical(footwall_render_failure)
      failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);

  Canvas canvas(width, height, picture.rgba);
  const bool has_words = !scene.labels.empty() || !scene.bars.empty() || !scene.legend.empty() ||
                         !scene.title.empty() || !scene.subtitle.empty() || scene.north_arrow ||
                         scene.orientation_axes;
  const std::unique_ptr<Typeface> typeface = has_words ? Typeface::find() : nullptr;
  if (typeface) {
    draw_labels(canvas, *typeface, scene, camera, picture.depth);
    draw_title(canvas, *typeface, scene);
  }
  if (scene.orientation_axes) {
    draw_orientation_axes(canvas, typeface.get(), scene, camera);
  } else if (scene.north_arrow) {
    draw_north_arrow(canvas, typeface.get(), scene, camera);
  }
  draw_panels(canvas, typeface.get(), scene);
  return picture;
}

}  // namespace footwall::render
