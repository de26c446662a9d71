// Signed integers of a fixed number of 64-bit words (two's complement, lowest word first), wide enough that a
// sum of float32 values, or of their squares, never rounds; and the one rounding at the end.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace footwall::extract {

__extension__ typedef __int128 Int128;
__extension__ typedef unsigned __int128 UInt128;

template <std::size_t Words>
class WideInteger {
 public:
  static constexpr std::size_t kWords = Words;

  // Adds m * 2^shift. A negative shift needs m to be a multiple of 2^-shift; |m| < 2^63.
  void add(std::int64_t m, int shift) {
    if (shift < 0) {
      m >>= -shift;
      shift = 0;
    }
    const UInt128 part = static_cast<UInt128>(static_cast<Int128>(m)) << (shift % 64);
    const std::uint64_t fill = m < 0 ? ~std::uint64_t{0} : 0;
    std::size_t word = static_cast<std::size_t>(shift) / 64;
    UInt128 carry = static_cast<UInt128>(words_[word]) + static_cast<std::uint64_t>(part);
    words_[word] = static_cast<std::uint64_t>(carry);
    if (++word == Words) return;
    carry = (carry >> 64) + words_[word] + static_cast<std::uint64_t>(part >> 64);
    words_[word] = static_cast<std::uint64_t>(carry);
    // Adding the sign's words changes nothing more once the carry equals the sign.
    while (++word < Words && (carry >> 64) != (fill & 1)) {
      carry = (carry >> 64) + words_[word] + fill;
      words_[word] = static_cast<std::uint64_t>(carry);
    }
  }

  void add(const WideInteger& other) {
    UInt128 carry = 0;
    for (std::size_t word = 0; word < Words; ++word) {
      carry = (carry >> 64) + words_[word] + other.words_[word];
      words_[word] = static_cast<std::uint64_t>(carry);
    }
  }

  bool negative() const { return (words_[Words - 1] >> 63) != 0; }
  std::array<std::uint64_t, Words> magnitude() const {
    std::array<std::uint64_t, Words> result = words_;
    if (!negative()) return result;
    UInt128 carry = UInt128{1} << 64;
    for (std::uint64_t& word : result) {
      carry = (carry >> 64) + static_cast<std::uint64_t>(~word);
      word = static_cast<std::uint64_t>(carry);
    }
    return result;
  }
  std::span<const std::uint64_t, Words> words() const { return words_; }
  std::span<std::uint64_t, Words> words() { return words_; }
  friend bool operator==(const WideInteger&, const WideInteger&) = default;

 private:
  std::array<std::uint64_t, Words> words_{};
};

// The double nearest (ties to even) to +-magnitude * 2^exponent / (divisor * second_divisor). At most 24
// words; divisors > 0; the result must be zero or a normal double, as all means and variances of float32
// values are.
double nearest_quotient(std::span<const std::uint64_t> magnitude, bool negative, int exponent,
                        std::uint64_t divisor, std::uint64_t second_divisor = 1);

}  // namespace footwall::extract
