#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/render/light_pixels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again.
#include <hwy/highway.h>

#include "engine/render/light_pixels.h"

HWY_BEFORE_NAMESPACE();
namespace footwall::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr float kAmbient = 0.26F;
constexpr float kHeadlight = 0.56F;
constexpr float kLamp = 0.34F;
constexpr float kBackSide = 0.80F;
// Towards the lamp, of length 1: right, up, towards the eye.
constexpr float kLampRight = -0.60F;
constexpr float kLampUp = 0.64F;
constexpr float kLampNear = 0.48F;

void light_all(const std::array<float, 9>& m, Rgba colour, const LitPixels& pixels, Rgba* HWY_RESTRICT to) {
  const hn::CappedTag<float, 16> d;
  const hn::RebindToUnsigned<decltype(d)> words;
  const hn::RebindToSigned<decltype(d)> ints;
  using V = hn::Vec<decltype(d)>;
  const auto set = [&](float v) HWY_ATTR { return hn::Set(d, v); };
  const V zero = hn::Zero(d);
  const V tiny = set(1e-30F);
  const auto if_positive = [&](V v) HWY_ATTR { return hn::IfThenElseZero(hn::Gt(v, zero), v); };
  for (std::size_t n = 0; n < pixels.count; n += hn::Lanes(d)) {
    const V side = hn::Load(d, pixels.side + n);
    V light = zero;
    V sum = zero;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const V nx = hn::Load(d, pixels.x[corner] + n);
      const V ny = hn::Load(d, pixels.y[corner] + n);
      const V nz = hn::Load(d, pixels.z[corner] + n);
      const auto row = [&](std::size_t r) HWY_ATTR {
        return hn::Add(hn::Add(hn::Mul(set(m[3 * r]), nx), hn::Mul(set(m[3 * r + 1]), ny)),
                       hn::Mul(set(m[3 * r + 2]), nz));
      };
      const V x = row(0);
      const V y = row(1);
      const V z = row(2);
      const V size = hn::Sqrt(hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z)));
      const V inverse = hn::Div(side, hn::IfThenElse(hn::Gt(size, tiny), size, tiny));
      const V facing = if_positive(hn::Mul(z, inverse));
      const V along =
          hn::Add(hn::Add(hn::Mul(x, set(kLampRight)), hn::Mul(y, set(kLampUp))), hn::Mul(z, set(kLampNear)));
      const V lamp = if_positive(hn::Mul(along, inverse));
      const V brightness =
          hn::Add(hn::Add(set(kAmbient), hn::Mul(set(kHeadlight), facing)), hn::Mul(set(kLamp), lamp));
      const V weight = hn::Load(d, pixels.weight[corner] + n);
      light = hn::Add(light, hn::Mul(weight, brightness));
      sum = hn::Add(sum, weight);
    }
    const V share = hn::IfThenElse(hn::Lt(side, zero), set(kBackSide), set(1));
    const V brightness = hn::Mul(hn::Div(light, sum), share);
    const auto channel = [&](unsigned value) HWY_ATTR {
      const V bright = if_positive(hn::Add(hn::Mul(set(static_cast<float>(value)), brightness), set(0.5F)));
      return hn::BitCast(words, hn::ConvertTo(ints, hn::Min(bright, set(255))));
    };
    const auto red_green = hn::Or(channel(red(colour)), hn::ShiftLeft<8>(channel(green(colour))));
    const auto blue_alpha = hn::Or(hn::ShiftLeft<16>(channel(blue(colour))), hn::Set(words, 0xff000000U));
    hn::StoreU(hn::Or(red_green, blue_alpha), words, to + n);
  }
}

}  // namespace
}  // namespace footwall::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace footwall::render {
namespace {

HWY_EXPORT(light_all);

}  // namespace

void light_pixels(const std::array<float, 9>& to_view, Rgba colour, const LitPixels& pixels,
                  std::span<Rgba, LitPixels::kRoom> to) {
  HWY_DYNAMIC_DISPATCH(light_all)(to_view, colour, pixels, to.data());
}

}  // namespace footwall::render
#endif
