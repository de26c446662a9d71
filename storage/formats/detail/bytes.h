// Numbers out of bytes in either byte order.
#pragma once
#include <bit>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace footwall::formats::detail {

static_assert(std::endian::native == std::endian::little,
              "the file formats are written for little-endian machines");

constexpr std::uint8_t swapped(std::uint8_t v) {
  return v;
}
constexpr std::uint16_t swapped(std::uint16_t v) {
  return __builtin_bswap16(v);
}
constexpr std::uint32_t swapped(std::uint32_t v) {
  return __builtin_bswap32(v);
}
constexpr std::uint64_t swapped(std::uint64_t v) {
  return __builtin_bswap64(v);
}

template <std::size_t kSize>
using UnsignedOf =
    std::conditional_t<kSize == 1, std::uint8_t,
                       std::conditional_t<kSize == 2, std::uint16_t,
                                          std::conditional_t<kSize == 4, std::uint32_t, std::uint64_t>>>;

// The number that starts at p; kSwap where the file's byte order is not the machine's.
template <class Number, bool kSwap>
Number load(const std::byte* p) {
  UnsignedOf<sizeof(Number)> bits;
  std::memcpy(&bits, p, sizeof bits);
  if constexpr (kSwap) bits = swapped(bits);
  return std::bit_cast<Number>(bits);
}

template <class Number>
Number load(const std::byte* p, bool swap) {
  return swap ? load<Number, true>(p) : load<Number, false>(p);
}

}  // namespace footwall::formats::detail
