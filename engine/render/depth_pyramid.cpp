// Compiled once per instruction set and chosen at run time; whole numbers but for one product, rounded alike
// on all of them.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/render/depth_pyramid.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>

#include "engine/render/depth_pyramid.h"

#ifndef FOOTWALL_RENDER_COARSE_RECTANGLE
#define FOOTWALL_RENDER_COARSE_RECTANGLE
namespace footwall::render {

// Numbers of a level: `first` is the upper left one.
struct CoarseRectangle {
  std::size_t first = 0;
  std::size_t step = 0;
  std::size_t width = 0;
  std::size_t height = 0;
};

}  // namespace footwall::render
#endif

HWY_BEFORE_NAMESPACE();
namespace footwall::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Coarse = hn::CappedTag<CoarseDepth, 16>;

bool all_at_most(const CoarseDepth* HWY_RESTRICT pixels, const CoarseRectangle& part, CoarseDepth most) {
  const Coarse d;
  const std::size_t lanes = hn::Lanes(d);
  const auto limit = hn::Set(d, most);
  for (std::size_t y = 0; y < part.height; ++y) {
    const CoarseDepth* const row = pixels + part.first + y * part.step;
    for (std::size_t x = 0; x < part.width; x += lanes) {
      const auto here = hn::IfThenElseZero(hn::FirstN(d, part.width - x), hn::LoadU(d, row + x));
      if (!hn::AllTrue(d, hn::Eq(hn::Max(here, limit), limit))) return false;
    }
  }
  return true;
}

void cover_all(CoarseDepth* HWY_RESTRICT pixels, const CoarseRectangle& part, CoarseDepth depth) {
  const Coarse d;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t y = 0; y < part.height; ++y) {
    CoarseDepth* const row = pixels + part.first + y * part.step;
    for (std::size_t x = 0; x < part.width; x += lanes) {
      const auto value =
          hn::IfThenElse(hn::FirstN(d, part.width - x), hn::Set(d, depth), hn::Set(d, kOpenPixel));
      hn::StoreU(hn::Min(value, hn::LoadU(d, row + x)), d, row + x);
    }
  }
}

void keep_open(const CoarseDepth* HWY_RESTRICT from, std::size_t count, CoarseDepth* HWY_RESTRICT to) {
  for (std::size_t x = 0; x < count; ++x) to[x] = from[x] == kOpenPixel ? kOpenPixel : CoarseDepth{0};
}

// Of one row; bits as mark_closed() wants them.
void mark_row(const CoarseDepth* HWY_RESTRICT now, const CoarseDepth* HWY_RESTRICT before, std::size_t count,
              std::uint64_t* HWY_RESTRICT bits) {
  const Coarse d;
  const std::size_t lanes = hn::Lanes(d);
  const auto open = hn::Set(d, kOpenPixel);
  for (std::size_t x = 0; x < count; x += lanes) {
    // Behind the row's end both are taken for hidden.
    const auto was = hn::IfThenElseZero(hn::FirstN(d, count - x), hn::LoadU(d, before + x));
    const auto is_closed = hn::And(hn::Eq(was, open), hn::Ne(hn::LoadU(d, now + x), open));
    std::uint8_t some[8] = {};
    hn::StoreMaskBits(d, is_closed, some);
    const std::uint64_t word = some[0] | std::uint64_t{some[1]} << 8U;
    bits[x / 64] |= word << (x % 64);
  }
}

void round_row(const Visible* HWY_RESTRICT from, std::size_t count, float least, float steps,
               CoarseDepth* HWY_RESTRICT to) {
  std::size_t x = 0;
#if HWY_TARGET != HWY_SCALAR
  const hn::ScalableTag<std::uint64_t> wide;
  const hn::Rebind<std::uint32_t, decltype(wide)> words;
  const hn::Rebind<float, decltype(wide)> floats;
  const hn::Rebind<std::int32_t, decltype(wide)> ints;
  const hn::Rebind<CoarseDepth, decltype(wide)> coarse;
  const std::size_t lanes = hn::Lanes(wide);
  const auto last = hn::Set(floats, static_cast<float>(kOpenPixel));
  for (; x + lanes <= count; x += lanes) {
    const auto bits = hn::TruncateTo(words, hn::ShiftRight<32>(hn::LoadU(wide, from + x)));
    const auto depth = hn::BitCast(floats, bits);
    const auto step = hn::Mul(hn::Sub(depth, hn::Set(floats, least)), hn::Set(floats, steps));
    const auto above = hn::Add(hn::Max(step, hn::Zero(floats)), hn::Set(floats, 1.0F));
    // A depth of 1 is the background's, or as good as that.
    const auto seen = hn::Lt(depth, hn::Set(floats, 1.0F));
    const auto kept = hn::IfThenElse(seen, hn::Min(above, last), last);
    hn::StoreU(hn::DemoteTo(coarse, hn::ConvertTo(ints, kept)), coarse, to + x);
  }
#endif
  for (; x < count; ++x) {
    const float depth = depth_of(from[x]);
    const float above = std::max((depth - least) * steps, 0.0F) + 1.0F;
    to[x] =
        depth < 1.0F ? static_cast<CoarseDepth>(std::min(above, static_cast<float>(kOpenPixel))) : kOpenPixel;
  }
}

// The greatest of each two by two.
void halve_row(const CoarseDepth* HWY_RESTRICT upper, const CoarseDepth* HWY_RESTRICT lower,
               std::size_t count, CoarseDepth* HWY_RESTRICT to) {
  std::size_t x = 0;
#if HWY_TARGET != HWY_SCALAR
  const Coarse d;
  const std::size_t lanes = hn::Lanes(d);
  for (; x + lanes <= count; x += lanes) {
    hn::Vec<Coarse> even_up, odd_up, even_low, odd_low;
    hn::LoadInterleaved2(d, upper + 2 * x, even_up, odd_up);
    hn::LoadInterleaved2(d, lower + 2 * x, even_low, odd_low);
    hn::StoreU(hn::Max(hn::Max(even_up, odd_up), hn::Max(even_low, odd_low)), d, to + x);
  }
#endif
  for (; x < count; ++x) to[x] = std::max({upper[2 * x], upper[2 * x + 1], lower[2 * x], lower[2 * x + 1]});
}

}  // namespace
}  // namespace footwall::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "storage/base/error.h"

namespace footwall::render {
namespace {

HWY_EXPORT(all_at_most);
HWY_EXPORT(cover_all);
HWY_EXPORT(keep_open);
HWY_EXPORT(mark_row);
HWY_EXPORT(round_row);
HWY_EXPORT(halve_row);

// What may be read and written back behind a row or the last pixel.
constexpr std::size_t kBeyond = 64;
// Boxes of at most so many numbers each way are looked at as they are; larger ones on a coarser level.
constexpr int kLookedAt = 16;
constexpr int kManyRows = 5;

}  // namespace

DepthScale DepthScale::between(double nearest, double farthest) {
  const double least = std::max(0.0, nearest - 2 * kSlack);
  const double range = std::max(std::min(1.0, farthest + 2 * kSlack) - least, 1e-6);
  // As float32, in which pixels are rounded; their products are off by less than 1/64 step.
  const auto rounded = static_cast<float>(least);
  return {rounded, static_cast<float>(65530 / range)};
}

DepthPyramid::DepthPyramid(const ScreenBox& window)
    : window_(window),
      width_(window.empty() ? 0 : window.x1 - window.x0 + 1),
      height_(window.empty() ? 0 : window.y1 - window.y0 + 1) {
  std::size_t first = 0;
  for (int width = width_, height = height_;; width = (width + 1) / 2, height = (height + 1) / 2) {
    Level level{width, height, first, static_cast<std::size_t>(width + 1) / 2 * 2, 0};
    // An even number of rows, so that the level above has its four everywhere.
    first += level.step * (static_cast<std::size_t>(height + 1) / 2 * 2);
    level.first_beyond = first;
    levels_.push_back(level);
    if (width <= kLookedAt && height <= kLookedAt) break;
  }
  pixels_.resize(first + kBeyond);
  open();
}

void DepthPyramid::open() {
  std::fill(pixels_.begin(), pixels_.end(), kOpenPixel);
}

void DepthPyramid::assign(const VisibilityBuffer& picture, const DepthScale& scale) {
  const auto least = static_cast<float>(scale.least);
  const auto steps = static_cast<float>(scale.steps);
  const auto round = HWY_DYNAMIC_DISPATCH(round_row);
  for (int y = 0; y < height_; ++y) {
    const std::span<const Visible> row =
        picture.row(window_.y0 + y)
            .subspan(static_cast<std::size_t>(window_.x0), static_cast<std::size_t>(width_));
    round(row.data(), row.size(), least, steps, pixels_.data() + static_cast<std::size_t>(y) * row_step());
  }
}

void DepthPyramid::assign(const DepthPyramid& other) {
  require(window_ == other.window_, "pyramids of the same window");
  std::copy_n(other.pixels_.begin(), levels_.front().first_beyond, pixels_.begin());
}

void DepthPyramid::assign_open(const DepthPyramid& other) {
  require(window_ == other.window_, "pyramids of the same window");
  HWY_DYNAMIC_DISPATCH(keep_open)(other.pixels_.data(), levels_.front().first_beyond, pixels_.data());
}

void DepthPyramid::cover(const ScreenBox& box, CoarseDepth depth) {
  const int x0 = std::max(box.x0, window_.x0) - window_.x0;
  const int x1 = std::min(box.x1, window_.x1) - window_.x0;
  const int y0 = std::max(box.y0, window_.y0) - window_.y0;
  const int y1 = std::min(box.y1, window_.y1) - window_.y0;
  if (x0 > x1 || y0 > y1) return;
  const CoarseRectangle part{static_cast<std::size_t>(y0) * row_step() + static_cast<std::size_t>(x0),
                             row_step(), static_cast<std::size_t>(x1 - x0 + 1),
                             static_cast<std::size_t>(y1 - y0 + 1)};
  HWY_DYNAMIC_DISPATCH(cover_all)(pixels_.data(), part, depth);
}

void DepthPyramid::build() {
  const auto halve = HWY_DYNAMIC_DISPATCH(halve_row);
  for (std::size_t n = 0; n < levels_.size(); ++n) {
    const Level& level = levels_[n];
    CoarseDepth* const first = pixels_.data() + level.first;
    // What stands behind the ends is no pixel: hidden, so that it does not open what lies above.
    if (static_cast<std::size_t>(level.width) < level.step) {
      for (int y = 0; y < level.height; ++y) first[static_cast<std::size_t>(y + 1) * level.step - 1] = 0;
    }
    if (level.height % 2 != 0)
      std::fill_n(first + static_cast<std::size_t>(level.height) * level.step, level.step, CoarseDepth{0});
    if (n + 1 == levels_.size()) break;
    const Level& above = levels_[n + 1];
    for (int y = 0; y < above.height; ++y) {
      const CoarseDepth* const row = first + 2 * static_cast<std::size_t>(y) * level.step;
      halve(row, row + level.step, static_cast<std::size_t>(above.width),
            pixels_.data() + above.first + static_cast<std::size_t>(y) * above.step);
    }
  }
}

bool DepthPyramid::hides(const ScreenBox& box) const {
  int x0 = std::max(box.x0, window_.x0) - window_.x0;
  int x1 = std::min(box.x1, window_.x1) - window_.x0;
  int y0 = std::max(box.y0, window_.y0) - window_.y0;
  int y1 = std::min(box.y1, window_.y1) - window_.y0;
  if (x0 > x1 || y0 > y1) return true;
  std::size_t n = 0;
  while (n + 1 < levels_.size() && (x1 - x0 >= kLookedAt || y1 - y0 >= kLookedAt)) {
    x0 /= 2;
    x1 /= 2;
    y0 /= 2;
    y1 /= 2;
    ++n;
  }
  const auto is_behind = [&, at_most = HWY_DYNAMIC_DISPATCH(all_at_most)](std::size_t number, int shift) {
    const Level& level = levels_[number];
    const auto left = static_cast<std::size_t>(x0 >> shift);
    const auto top = static_cast<std::size_t>(y0 >> shift);
    return at_most(
        pixels_.data(),
        {level.first + top * level.step + left, level.step, static_cast<std::size_t>(x1 >> shift) - left + 1,
         static_cast<std::size_t>(y1 >> shift) - top + 1},
        box.nearest);
  };
  // What is hidden mostly is so on a coarser level, too, where there is less to look at.
  if (y1 - y0 >= kManyRows && n + 2 < levels_.size() && is_behind(n + 2, 2)) return true;
  return is_behind(n, 0);
}

bool DepthPyramid::is_closed(const ScreenBox& box) const {
  ScreenBox last = box;
  last.nearest = kOpenPixel - 1;
  return hides(last);
}

void DepthPyramid::mark_closed(const DepthPyramid& other, std::span<std::uint64_t> bits) const {
  require(window_ == other.window_, "pyramids of the same window");
  const auto mark = HWY_DYNAMIC_DISPATCH(mark_row);
  for (int y = 0; y < height_; ++y) {
    const std::size_t first = static_cast<std::size_t>(y) * row_step();
    mark(pixels_.data() + first, other.pixels_.data() + first, static_cast<std::size_t>(width_),
         bits.data() + static_cast<std::size_t>(y) * words_a_row());
  }
}

}  // namespace footwall::render
#endif
