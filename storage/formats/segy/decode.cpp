#include "storage/formats/segy/decode.h"

#include <bit>
#include <cmath>
#include <limits>

#include "storage/base/error.h"
#include "storage/formats/detail/bytes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "storage/formats/segy/decode.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace footwall::formats::segy::HWY_NAMESPACE {

using detail::load;

constexpr float kLargest = std::numeric_limits<float>::max();

// Plain loops without branches: the compiler turns them into the target's vectors.
// Every kind: kSize bytes a sample; value() gives the float32 and adds to `beyond` if it had to be cut.

// fraction * 2^(4 exponent - 280), where 2^n may be far outside float32. The fraction's 24 bits fit into a
// float32; the first factor keeps the product normal, hence exact, so that only the second one can round
// (below 2^-126) or overflow, and it does so as the exact value would.
struct Ibm {
  static constexpr std::int64_t kSize = 4;
  template <bool kSwap>
  static HWY_ATTR inline float value(const std::byte* p, std::uint32_t& beyond) {
    const auto bits = load<std::uint32_t, kSwap>(p);
    const auto power = static_cast<std::int32_t>((bits >> 22) & 0x1FCU) - 280;
    const std::int32_t first = power < -100 ? -100 : (power > 101 ? 101 : power);
    const std::int32_t rest = power - first < -126 ? -126 : power - first;  // at most 127
    const float magnitude = static_cast<float>(static_cast<std::int32_t>(bits & 0x00FFFFFFU)) *
                            std::bit_cast<float>((first + 127) << 23) *
                            std::bit_cast<float>((rest + 127) << 23);
    const bool over = magnitude > kLargest;
    beyond += over ? 1U : 0U;
    const auto cut = std::bit_cast<std::uint32_t>(over ? kLargest : magnitude);
    return std::bit_cast<float>(cut | (bits & 0x80000000U));
  }
};

template <class Number>
struct Plain {
  static constexpr std::int64_t kSize = sizeof(Number);
  template <bool kSwap>
  static HWY_ATTR inline float value(const std::byte* p, std::uint32_t&) {
    return static_cast<float>(load<Number, kSwap>(p));
  }
};

struct Double {
  static constexpr std::int64_t kSize = 8;
  template <bool kSwap>
  static HWY_ATTR inline float value(const std::byte* p, std::uint32_t& beyond) {
    const auto number = load<double, kSwap>(p);
    const double size = std::fabs(number);
    const bool over = size > static_cast<double>(kLargest) && size < std::numeric_limits<double>::infinity();
    beyond += over ? 1U : 0U;
    return over ? std::copysign(kLargest, static_cast<float>(number)) : static_cast<float>(number);
  }
};

template <bool kSigned>
struct ThreeBytes {
  static constexpr std::int64_t kSize = 3;
  template <bool kSwap>
  static HWY_ATTR inline float value(const std::byte* p, std::uint32_t&) {
    const std::uint32_t middle = std::to_integer<std::uint32_t>(p[1]) << 8;
    const auto first = std::to_integer<std::uint32_t>(p[0]);
    const auto last = std::to_integer<std::uint32_t>(p[2]);
    const std::uint32_t bits = kSwap ? first << 16 | middle | last : last << 16 | middle | first;
    return static_cast<float>(kSigned ? static_cast<std::int32_t>(bits << 8) >> 8
                                      : static_cast<std::int32_t>(bits));
  }
};

template <class Kind, bool kSwap>
HWY_ATTR std::int64_t decode_all(const std::byte* __restrict in, float* __restrict out, std::int64_t count) {
  std::uint32_t beyond = 0;  // 32 bits a lane like the samples; a trace has less than 2^32 of them
  for (std::int64_t n = 0; n < count; ++n) {
    out[n] = Kind::template value<kSwap>(in + n * Kind::kSize, beyond);
  }
  return beyond;
}

template <bool kSwap>
HWY_ATTR std::int64_t decode_any(int code, const std::byte* in, float* out, std::int64_t count) {
  switch (code) {
    case 1:
      return decode_all<Ibm, kSwap>(in, out, count);
    case 2:
      return decode_all<Plain<std::int32_t>, kSwap>(in, out, count);
    case 3:
      return decode_all<Plain<std::int16_t>, kSwap>(in, out, count);
    case 5:
      return decode_all<Plain<float>, kSwap>(in, out, count);
    case 6:
      return decode_all<Double, kSwap>(in, out, count);
    case 7:
      return decode_all<ThreeBytes<true>, kSwap>(in, out, count);
    case 8:
      return decode_all<Plain<std::int8_t>, kSwap>(in, out, count);
    case 9:
      return decode_all<Plain<std::int64_t>, kSwap>(in, out, count);
    case 10:
      return decode_all<Plain<std::uint32_t>, kSwap>(in, out, count);
    case 11:
      return decode_all<Plain<std::uint16_t>, kSwap>(in, out, count);
    case 12:
      return decode_all<Plain<std::uint64_t>, kSwap>(in, out, count);
    case 15:
      return decode_all<ThreeBytes<false>, kSwap>(in, out, count);
    case 16:
      return decode_all<Plain<std::uint8_t>, kSwap>(in, out, count);
    default:
      return -1;
  }
}

HWY_ATTR std::int64_t decode_here(int code, bool swap, const std::byte* in, float* out, std::int64_t count) {
  return swap ? decode_any<true>(code, in, out, count) : decode_any<false>(code, in, out, count);
}

}  // namespace footwall::formats::segy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace footwall::formats::segy {

HWY_EXPORT(decode_here);

std::int64_t decode(int code, bool swap, const std::byte* in, std::span<float> out) {
  const std::int64_t beyond =
      HWY_DYNAMIC_DISPATCH(decode_here)(code, swap, in, out.data(), static_cast<std::int64_t>(out.size()));
  require(beyond >= 0, "a sample format that can be read");
  return beyond;
}

}  // namespace footwall::formats::segy
#endif
