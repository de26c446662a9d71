// Whole numbers of 1152 bits: wide enough for polynomials of degree four in differences of floats, taken in
// units of the smallest float (2^-149), so that their signs are exact.
#pragma once
#include <array>
#include <bit>
#include <cstdint>

namespace footwall::isosurface {

class WideInteger {
 public:
  WideInteger() = default;
  // In units of 2^-149. A finite number.
  explicit WideInteger(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t exponent = bits >> 23 & 0xFFU;
    std::uint64_t mantissa = bits & 0x7FFFFFU;
    unsigned shift = 0;
    if (exponent != 0) {
      mantissa |= 0x800000U;
      shift = exponent - 1;
    }
    words_[shift / 64] = mantissa << shift % 64;
    if (shift % 64 != 0) words_[shift / 64 + 1] = mantissa >> (64 - shift % 64);
    if (bits >> 31 != 0) *this = WideInteger() - *this;
  }

  int sign() const {
    if (words_.back() >> 63 != 0) return -1;
    for (const std::uint64_t word : words_) {
      if (word != 0) return 1;
    }
    return 0;
  }

  friend WideInteger operator+(const WideInteger& a, const WideInteger& b) {
    WideInteger sum;
    Double carry = 0;
    for (std::size_t n = 0; n < kWords; ++n) {
      carry += static_cast<Double>(a.words_[n]) + b.words_[n];
      sum.words_[n] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    return sum;
  }
  friend WideInteger operator-(const WideInteger& a, const WideInteger& b) {
    WideInteger difference;
    std::uint64_t borrow = 0;
    for (std::size_t n = 0; n < kWords; ++n) {
      const Double step = static_cast<Double>(a.words_[n]) - b.words_[n] - borrow;
      difference.words_[n] = static_cast<std::uint64_t>(step);
      borrow = static_cast<std::uint64_t>(step >> 64) & 1U;
    }
    return difference;
  }
  // Two's complement: what is above 1152 bits drops out, of negative numbers too.
  friend WideInteger operator*(const WideInteger& a, const WideInteger& b) {
    WideInteger product;
    for (std::size_t n = 0; n < kWords; ++n) {
      if (a.words_[n] == 0) continue;
      Double carry = 0;
      for (std::size_t m = 0; n + m < kWords; ++m) {
        carry += static_cast<Double>(a.words_[n]) * b.words_[m] + product.words_[n + m];
        product.words_[n + m] = static_cast<std::uint64_t>(carry);
        carry >>= 64;
      }
    }
    return product;
  }

 private:
  static constexpr std::size_t kWords = 18;
  __extension__ using Double = unsigned __int128;

  std::array<std::uint64_t, kWords> words_{};  // the lowest first
};

}  // namespace footwall::isosurface
