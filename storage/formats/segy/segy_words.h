// The bytes of SEG-Y headers that are written: big-endian words by the standard's byte numbers, and letters
// in EBCDIC.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "storage/formats/detail/bytes.h"
#include "storage/formats/segy/text_header.h"

namespace footwall::formats::segy {

class Words {
 public:
  // A header of `size` zeros whose first byte has the number `before` + 1.
  Words(std::size_t size, int before) : bytes_(size), before_(before) {}

  void int16(int byte, int value) { put(byte, static_cast<std::uint16_t>(value)); }
  void uint16(int byte, int value) { put(byte, static_cast<std::uint16_t>(value)); }
  void int32(int byte, std::int32_t value) { put(byte, static_cast<std::uint32_t>(value)); }
  void int64(int byte, std::int64_t value) { put(byte, static_cast<std::uint64_t>(value)); }
  void float64(int byte, double value) { put(byte, std::bit_cast<std::uint64_t>(value)); }
  std::span<const std::byte> bytes() const { return bytes_; }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  template <class Unsigned>
  void put(int byte, Unsigned bits) {
    bits = detail::swapped(bits);
    std::memcpy(bytes_.data() + (byte - before_ - 1), &bits, sizeof bits);
  }
  std::vector<std::byte> bytes_;
  int before_;
};

// '?' for what the code page does not have.
inline std::byte ebcdic_from(char letter) {
  if (letter == ' ') return std::byte{0x40};
  for (int code = 0x41; code < 256; ++code) {
    if (decoded(std::byte(code), true) == letter) return std::byte(code);
  }
  return std::byte{0x6F};
}

}  // namespace footwall::formats::segy
