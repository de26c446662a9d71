#include "engine/render/surface_layer.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "scratch_folder.h"
#include "storage/base/error.h"

namespace footwall::render {
namespace {

constexpr int kWidth = 37;
constexpr int kHeight = 23;

struct Part {
  VisibilityBuffer window{kWidth, kHeight};
  std::vector<Rgba> colours = std::vector<Rgba>(kWidth * kHeight);
};

// share: of the pixels that show something.
Part random_part(unsigned seed, double share) {
  std::mt19937 random(seed);
  Part part;
  for (std::size_t n = 0; n < part.colours.size(); ++n) {
    if (static_cast<double>(random() % 1000) >= share * 1000) continue;
    part.window.pixels()[n] = visible(static_cast<float>(random() % 8) / 8, random() % 1000);
    part.colours[n] = random() | 0xff000000U;
  }
  return part;
}

TEST(SurfaceLayer, MergingIsTheLeastOfEachPixelWithItsColour) {
  for (const double share : {0.0, 0.02, 0.5, 1.0}) {
    const Part one = random_part(1, 0.4);
    const Part other = random_part(2, share);
    Part merged = one;
    // In two halves, as ranks would send them.
    std::vector<std::byte> upper;
    std::vector<std::byte> lower;
    const std::size_t taken =
        encode_pixels(other.window, other.colours, 0, 9, PixelKind::kVisible, upper) +
        encode_pixels(other.window, other.colours, 9, kHeight, PixelKind::kVisible, lower);
    merge_pixels(upper, merged.window, merged.colours);
    merge_pixels(lower, merged.window, merged.colours);
    std::size_t seen = 0;
    for (std::size_t n = 0; n < merged.colours.size(); ++n) {
      const Visible a = one.window.pixels()[n];
      const Visible b = other.window.pixels()[n];
      seen += b != kBackground ? 1 : 0;
      ASSERT_EQ(merged.window.pixels()[n], std::min(a, b));
      ASSERT_EQ(merged.colours[n], b < a ? other.colours[n] : one.colours[n]);
    }
    EXPECT_EQ(taken, seen);
  }
}

TEST(SurfaceLayer, BackgroundCostsNothing) {
  Part part;
  std::vector<std::byte> bytes;
  EXPECT_EQ(encode_pixels(part.window, part.colours, 0, kHeight, PixelKind::kVisible, bytes), 0U);
  EXPECT_EQ(bytes.size(), 16U);
  part.window.row(20)[30] = visible(0.5F, 3);
  bytes.clear();
  EXPECT_EQ(encode_pixels(part.window, part.colours, 0, kHeight, PixelKind::kVisible, bytes), 1U);
  EXPECT_EQ(bytes.size(), 16U + 4 + 8 + 12);
}

TEST(SurfaceLayer, KeepsRowsAndSurvivesTheDisk) {
  const Part part = random_part(3, 0.3);
  SurfaceLayer layer(kWidth, kHeight);
  for (const auto& [begin, end] : {std::pair{11, 23}, std::pair{0, 11}}) {
    std::vector<std::byte> bytes;
    encode_pixels(part.window, part.colours, begin, end, PixelKind::kDepth, bytes);
    layer.add(std::move(bytes));
  }
  const ScratchFolder folder;
  layer.write(folder.path() / "layer");
  const SurfaceLayer read = SurfaceLayer::read(folder.path() / "layer");
  EXPECT_EQ(read.width(), kWidth);
  for (int y = 0; y < kHeight; ++y) {
    std::vector<float> depths(kWidth);
    std::vector<Rgba> colours(kWidth);
    read.row(y, depths, colours);
    for (int x = 0; x < kWidth; ++x) {
      const Visible pixel = part.window.at(x, y);
      ASSERT_EQ(depths[static_cast<std::size_t>(x)], depth_of(pixel));
      ASSERT_EQ(colours[static_cast<std::size_t>(x)],
                pixel == kBackground ? 0 : part.colours[static_cast<std::size_t>(y * kWidth + x)]);
    }
  }
  EXPECT_THROW(SurfaceLayer::read(folder.path() / "none"), Error);
}

TEST(SurfaceLayer, RefusesBytesThatAreNotWhole) {
  const Part part = random_part(4, 0.3);
  std::vector<std::byte> visibles;
  std::vector<std::byte> depths;
  encode_pixels(part.window, part.colours, 0, kHeight, PixelKind::kVisible, visibles);
  encode_pixels(part.window, part.colours, 0, kHeight, PixelKind::kDepth, depths);
  Part into;
  for (std::size_t size = 0; size < visibles.size(); size += 7) {
    EXPECT_THROW(merge_pixels(std::span(visibles).first(size), into.window, into.colours), Error) << size;
  }
  // Any altered byte either is refused or changes pixels alone.
  for (std::size_t at = 0; at < depths.size(); at += 5) {
    std::vector<std::byte> altered = depths;
    altered[at] ^= std::byte{0x55};
    SurfaceLayer layer(kWidth, kHeight);
    try {
      layer.add(std::move(altered));
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kCorrupt);
    }
  }
  SurfaceLayer twice(kWidth, kHeight);
  twice.add(depths);
  EXPECT_THROW(twice.add(depths), Error);
}

}  // namespace
}  // namespace footwall::render
