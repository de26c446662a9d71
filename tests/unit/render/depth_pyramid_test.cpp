#include "engine/render/depth_pyramid.h"

#include <gtest/gtest.h>

#include <random>

namespace footwall::render {
namespace {

struct Rectangle {
  ScreenBox box;
  double depth = 0;
};

Rectangle random_rectangle(std::mt19937& random, int width, int height, double least, double range) {
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const int x0 = below(width + 10) - 5;
  const int y0 = below(height + 10) - 5;
  const int across = random() % 8 == 0 ? 120 : 12;
  std::uniform_real_distribution<double> depth(least, least + range);
  return {{static_cast<std::int16_t>(x0), static_cast<std::int16_t>(y0),
           static_cast<std::int16_t>(x0 + below(across) - 1),
           static_cast<std::int16_t>(y0 + below(across) - 1), 0, 0},
          depth(random)};
}

// What is said to be hidden lies behind every pixel, and hardly anything else that does is missed.
TEST(DepthPyramid, HidesOnlyWhatLiesBehindEveryPixel) {
  std::mt19937 random(3);
  int hidden = 0;
  int missed = 0;
  for (const double range : {0.5, 0.01}) {
    const double least = 0.4;
    for (int round = 0; round < 12; ++round) {
      const int width = 1 + static_cast<int>(random() % 150);
      const int height = 1 + static_cast<int>(random() % 90);
      VisibilityBuffer picture(width, height);
      for (int n = 0; n < 80; ++n) {
        const Rectangle wall = random_rectangle(random, width, height, least, range);
        for (int y = std::max<int>(0, wall.box.y0); y <= std::min<int>(height - 1, wall.box.y1); ++y) {
          for (int x = std::max<int>(0, wall.box.x0); x <= std::min<int>(width - 1, wall.box.x1); ++x) {
            Visible& pixel = picture.row(y)[static_cast<std::size_t>(x)];
            pixel = std::min(pixel, visible(static_cast<float>(wall.depth), 7));
          }
        }
      }
      const DepthScale scale = DepthScale::between(least, least + range);
      DepthPyramid pyramid(
          {0, 0, static_cast<std::int16_t>(width - 1), static_cast<std::int16_t>(height - 1), 0, 0});
      pyramid.assign(picture, scale);
      pyramid.build();
      for (int n = 0; n < 400; ++n) {
        Rectangle asked = random_rectangle(random, width, height, least, range);
        asked.box.nearest = scale.of_box(asked.depth);
        bool is_hidden = true;
        bool is_far = true;  // by more than the steps' size
        for (int y = std::max<int>(0, asked.box.y0); y <= std::min<int>(height - 1, asked.box.y1); ++y) {
          for (int x = std::max<int>(0, asked.box.x0); x <= std::min<int>(width - 1, asked.box.x1); ++x) {
            const float depth = depth_of(picture.at(x, y));
            is_hidden = is_hidden && picture.at(x, y) != kBackground && depth < asked.depth;
            is_far = is_far && picture.at(x, y) != kBackground &&
                     depth + 4 * DepthScale::kSlack + range / 2e4 < asked.depth;
          }
        }
        const bool said = pyramid.hides(asked.box);
        if (said) {
          EXPECT_TRUE(is_hidden);
          ++hidden;
        } else if (is_far && asked.box.x1 - asked.box.x0 < 16 && asked.box.y1 - asked.box.y0 < 16) {
          ++missed;  // larger ones may be, since coarse levels know less
        }
      }
    }
  }
  EXPECT_GT(hidden, 500);
  EXPECT_EQ(missed, 0);
}

TEST(DepthPyramid, LeastOfPyramidsIsThatOfTheirPictures) {
  std::mt19937 random(4);
  const ScreenBox window{3, 2, 60, 40, 0, 0};
  const DepthScale scale = DepthScale::between(0.2, 0.9);
  VisibilityBuffer pictures[2] = {VisibilityBuffer(70, 50), VisibilityBuffer(70, 50)};
  std::uniform_real_distribution<float> depth(0.2F, 0.9F);
  for (VisibilityBuffer& picture : pictures) {
    for (Visible& pixel : picture.pixels())
      pixel = random() % 3 == 0 ? kBackground : visible(depth(random), 1);
  }
  DepthPyramid one(window);
  DepthPyramid other(window);
  one.assign(pictures[0], scale);
  other.assign(pictures[1], scale);
  for (std::size_t n = 0; n < one.pixels().size(); ++n)
    one.pixels()[n] = std::min(one.pixels()[n], other.pixels()[n]);
  pictures[0].merge(pictures[1]);
  other.assign(pictures[0], scale);
  for (int y = window.y0; y <= window.y1; ++y)
    EXPECT_TRUE(std::equal(one.row(y).begin(), one.row(y).end(), other.row(y).begin())) << y;
}

TEST(DepthPyramid, TellsTheFarthestOfABlock) {
  std::mt19937 random(4);
  const ScreenBox window{3, 5, 71, 42, 0, 0};
  DepthPyramid pyramid(window);
  for (int y = window.y0; y <= window.y1; ++y) {
    for (int x = window.x0; x <= window.x1; ++x)
      pyramid.cover({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y), static_cast<std::int16_t>(x),
                     static_cast<std::int16_t>(y), 0, 0},
                    static_cast<CoarseDepth>(random() % 60000));
  }
  pyramid.build();
  for (const std::size_t level : {0U, 1U, 2U}) {
    const int size = 1 << level;
    for (int y = window.y0; y <= window.y1; ++y) {
      for (int x = window.x0; x <= window.x1; ++x) {
        const int left = window.x0 + (x - window.x0) / size * size;
        const int top = window.y0 + (y - window.y0) / size * size;
        CoarseDepth farthest = 0;
        for (int row = top; row < top + size && row <= window.y1; ++row) {
          for (int column = left; column < left + size && column <= window.x1; ++column)
            farthest = std::max(farthest, pyramid.row(row)[static_cast<std::size_t>(column - window.x0)]);
        }
        ASSERT_EQ(pyramid.farthest_around(x, y, level), farthest);
      }
    }
  }
  EXPECT_EQ(pyramid.farthest_around(3, 5, 40), pyramid.farthest_around(3, 5, 3));  // 9 x 5 numbers
}

TEST(DepthPyramid, MarksWhatIsNoLongerOpen) {
  for (const int width : {1, 15, 64, 90, 129}) {
    const auto last = static_cast<std::int16_t>(9 + width);
    DepthPyramid before({10, 5, last, 44, 0, 0});
    before.cover({20, 10, 29, 19, 0, 0}, 100);
    before.build();
    DepthPyramid now(before.window());
    now.assign_open(before);
    std::vector<std::uint64_t> bits(now.words_a_row() * 40);
    const auto count = [&] {
      std::fill(bits.begin(), bits.end(), 0);
      now.mark_closed(before, bits);
      int all = 0;
      for (const std::uint64_t word : bits) all += std::popcount(word);
      return all;
    };
    EXPECT_EQ(count(), 0);
    for (int again = 0; again < 2; ++again) {
      now.cover({15, 10, 34, 10, 0, 0}, 0);
      now.build();
      EXPECT_EQ(count(), std::clamp(last - 14, 0, 20) - std::clamp(last - 19, 0, 10)) << width;
    }
    for (std::int16_t x = 10; x <= last; ++x) {
      const bool is_open = x < 15 || x > 34;
      EXPECT_EQ(now.is_closed({x, 10, x, 10, 0, 0}), !is_open) << x;
      EXPECT_FALSE(now.is_closed({x, 9, x, 10, 0, 0}));
    }
    now.cover({-5, -5, 200, 200, 0, 0}, 0);
    EXPECT_EQ(count(), width * 40 - 10 * std::clamp(last - 19, 0, 10));
  }
}

TEST(DepthPyramid, DepthsAreRoundedToTheSafeSide) {
  const DepthScale scale = DepthScale::between(0.25, 0.75);
  for (double depth = 0.251; depth < 0.749; depth += 0.001) {
    EXPECT_LT(scale.of_box(depth), scale.behind(depth));
    EXPECT_LE(scale.of_box(depth), scale.of_box(depth + 0.001));
  }
  EXPECT_EQ(scale.of_box(0), 0);
  EXPECT_LT(scale.of_box(1), kOpenPixel);
}

}  // namespace
}  // namespace footwall::render
