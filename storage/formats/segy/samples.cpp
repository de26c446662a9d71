#include "storage/formats/segy/samples.h"

#include <array>
#include <bit>

#include "storage/formats/segy/decode.h"

namespace footwall::formats::segy {
namespace {

// The fraction has 24 bits and the power of two is in double's range, so the product is exact.
inline double ibm_to_double(std::uint32_t bits) {
  const auto fraction = static_cast<double>(static_cast<std::int32_t>(bits & 0x00FFFFFFu));
  const std::uint64_t exponent = (bits >> 24) & 0x7Fu;
  // 16^(exponent - 64) / 2^24 = 2^(4 * exponent - 280)
  const auto scale = std::bit_cast<double>((4 * exponent + (1023 - 280)) << 52);
  const double magnitude = fraction * scale;
  return (bits >> 31) != 0 ? -magnitude : magnitude;
}

template <int kCode, bool kSwap>
std::int64_t decode_as(const std::byte* in, std::span<float> out) {
  return decode(kCode, kSwap, in, out);
}

template <int kCode, int kSize>
constexpr SampleFormat row(std::string_view name) {
  return {kCode, kSize, name, decode_as<kCode, true>, decode_as<kCode, false>};
}

constexpr std::array kFormats{
    row<1, 4>("IBM float32"),  row<2, 4>("int32"),   row<3, 2>("int16"),   row<5, 4>("IEEE float32"),
    row<6, 8>("IEEE float64"), row<7, 3>("int24"),   row<8, 1>("int8"),    row<9, 8>("int64"),
    row<10, 4>("uint32"),      row<11, 2>("uint16"), row<12, 8>("uint64"), row<15, 3>("uint24"),
    row<16, 1>("uint8"),
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
