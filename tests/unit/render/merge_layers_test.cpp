#include "engine/render/merge_layers.h"

#include <gtest/gtest.h>

#include <random>

#include "storage/base/error.h"

namespace footwall::render {
namespace {

constexpr int kWidth = 31;
constexpr int kHeight = 150;  // more than one band
constexpr std::size_t kPixels = std::size_t{kWidth} * kHeight;

struct Drawn {
  VisibilityBuffer window{kWidth, kHeight};
  std::vector<Rgba> colours = std::vector<Rgba>(kPixels);
  SurfaceLayer layer{kWidth, kHeight};
};

// share: of the pixels that show something; depths are few, so that many are as far away, up to the far
// plane.
Drawn random_layer(unsigned seed, double share) {
  std::mt19937 random(seed);
  Drawn drawn;
  drawn.window.clear();
  for (std::size_t n = 0; n < kPixels; ++n) {
    if (static_cast<double>(random() % 1000) >= share * 1000) continue;
    drawn.window.pixels()[n] = visible(static_cast<float>(random() % 9) / 8, random() % 1000);
    drawn.colours[n] = random() | 0xff000000U;
  }
  std::vector<std::byte> part;
  encode_pixels(drawn.window, drawn.colours, 0, kHeight, PixelKind::kDepth, part);
  drawn.layer.add(std::move(part));
  return drawn;
}

TEST(MergeLayers, TheNearerIsSeenAndOfEquallyNearTheFirst) {
  for (const auto& [share, other_share] :
       {std::pair{0.4, 0.6}, {0.0, 0.3}, {0.3, 0.0}, {1.0, 1.0}, {0.0, 0.0}}) {
    const Drawn first = random_layer(1, share);
    const Drawn second = random_layer(2, other_share);
    const SurfaceLayer merged = nearer_of(first.layer, second.layer);
    std::vector<float> depths(kWidth);
    std::vector<Rgba> colours(kWidth);
    for (int y = 0; y < kHeight; ++y) {
      merged.row(y, depths, colours);
      for (int x = 0; x < kWidth; ++x) {
        const auto n = static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x);
        const Visible a = first.window.pixels()[n];
        const Visible b = second.window.pixels()[n];
        const bool is_second = b != kBackground && (a == kBackground || depth_of(b) < depth_of(a));
        ASSERT_EQ(depths[static_cast<std::size_t>(x)], depth_of(is_second ? b : a));
        ASSERT_EQ(colours[static_cast<std::size_t>(x)], (is_second ? second : first).colours[n]);
      }
    }
  }
}

TEST(MergeLayers, OfOtherSizesAreRefused) {
  EXPECT_THROW(nearer_of(SurfaceLayer(3, 4), SurfaceLayer(4, 3)), Error);
}

}  // namespace
}  // namespace footwall::render
