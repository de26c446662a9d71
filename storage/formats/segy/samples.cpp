#include "storage/formats/segy/samples.h"

#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "storage/formats/detail/bytes.h"

namespace footwall::formats::segy {
namespace {

using detail::load;

constexpr double kLargest = std::numeric_limits<float>::max();

// The fraction has 24 bits and the power of two is in double's range, so the product is exact.
inline double ibm_to_double(std::uint32_t bits) {
  const auto fraction = static_cast<double>(static_cast<std::int32_t>(bits & 0x00FFFFFFu));
  const std::uint64_t exponent = (bits >> 24) & 0x7Fu;
  // 16^(exponent - 64) / 2^24 = 2^(4 * exponent - 280)
  const auto scale = std::bit_cast<double>((4 * exponent + (1023 - 280)) << 52);
  const double magnitude = fraction * scale;
  return (bits >> 31) != 0 ? -magnitude : magnitude;
}

struct Ibm {
  static constexpr int kSize = 4;
  template <bool kSwap>
  static double value(const std::byte* p) {
    return ibm_to_double(load<std::uint32_t, kSwap>(p));
  }
};

template <class Number>
struct Plain {
  static constexpr int kSize = sizeof(Number);
  template <bool kSwap>
  static Number value(const std::byte* p) {
    return load<Number, kSwap>(p);
  }
};

template <bool kSigned>
struct ThreeBytes {
  static constexpr int kSize = 3;
  template <bool kSwap>
  static std::int32_t value(const std::byte* p) {
    const auto byte = [p](int n) { return std::to_integer<std::uint32_t>(p[n]); };
    const std::uint32_t bits =
        kSwap ? byte(0) << 16 | byte(1) << 8 | byte(2) : byte(2) << 16 | byte(1) << 8 | byte(0);
    return kSigned ? static_cast<std::int32_t>(bits << 8) >> 8 : static_cast<std::int32_t>(bits);
  }
};

// Rounds to the nearest float32, ties to even. Only double can be finite and beyond float32.
template <class Kind, bool kSwap>
std::int64_t decode(const std::byte* in, std::span<float> out) {
  std::int64_t beyond = 0;
  for (std::size_t n = 0; n < out.size(); ++n) {
    const auto value = Kind::template value<kSwap>(in + n * Kind::kSize);
    if constexpr (std::is_same_v<std::remove_const_t<decltype(value)>, double>) {
      const double size = std::fabs(value);
      const bool over = size > kLargest && size < std::numeric_limits<double>::infinity();
      beyond += over ? 1 : 0;
      out[n] = static_cast<float>(over ? std::copysign(kLargest, value) : value);
    } else {
      out[n] = static_cast<float>(value);
    }
  }
  return beyond;
}

template <class Kind>
constexpr SampleFormat row(int code, std::string_view name) {
  return {code, Kind::kSize, name, decode<Kind, true>, decode<Kind, false>};
}

constexpr std::array kFormats{
    row<Ibm>(1, "IBM float32"),
    row<Plain<std::int32_t>>(2, "int32"),
    row<Plain<std::int16_t>>(3, "int16"),
    row<Plain<float>>(5, "IEEE float32"),
    row<Plain<double>>(6, "IEEE float64"),
    row<ThreeBytes<true>>(7, "int24"),
    row<Plain<std::int8_t>>(8, "int8"),
    row<Plain<std::int64_t>>(9, "int64"),
    row<Plain<std::uint32_t>>(10, "uint32"),
    row<Plain<std::uint16_t>>(11, "uint16"),
    row<Plain<std::uint64_t>>(12, "uint64"),
    row<ThreeBytes<false>>(15, "uint24"),
    row<Plain<std::uint8_t>>(16, "uint8"),
};

}  // namespace

const SampleFormat* sample_format(int code) {
  for (const SampleFormat& format : kFormats) {
    if (format.code == code) return &format;
  }
  return nullptr;
}

bool is_defined_format(int code) {
  return code == 4 || sample_format(code) != nullptr;
}

float ibm_to_float(std::uint32_t bits) {
  return static_cast<float>(ibm_to_double(bits));
}

}  // namespace footwall::formats::segy
