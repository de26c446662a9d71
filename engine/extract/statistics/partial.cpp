#include "engine/extract/statistics/partial.h"

#include <algorithm>
#include <bit>

#include "storage/base/error.h"

namespace footwall::extract {
namespace {

void put_number(std::uint64_t value, std::vector<std::byte>& out) {
  for (; value >= 0x80; value >>= 7) out.push_back(static_cast<std::byte>(value | 0x80));
  out.push_back(static_cast<std::byte>(value));
}

std::byte take_byte(std::span<const std::byte>& bytes) {
  require(!bytes.empty(), "a whole record of partial sums");
  const std::byte first = bytes.front();
  bytes = bytes.subspan(1);
  return first;
}

std::uint64_t take_number(std::span<const std::byte>& bytes) {
  std::uint64_t value = 0;
  for (int shift = 0; shift < 64; shift += 7) {
    const auto byte = static_cast<std::uint64_t>(take_byte(bytes));
    value |= (byte & 0x7f) << shift;
    if ((byte & 0x80) == 0) return value;
  }
  throw Error(ErrorCode::kInternal, "a number of partial sums has no end");
}

std::byte byte_of(std::span<const std::uint64_t> words, std::size_t n) {
  return static_cast<std::byte>(words[n / 8] >> (n % 8 * 8));
}

// A two's complement integer as: zero bytes left out at the low end, bytes that follow, those bytes. The
// bytes left out at the high end repeat the sign of the last one sent.
void put_words(std::span<const std::uint64_t> words, std::vector<std::byte>& out) {
  const std::size_t size = words.size() * 8;
  std::size_t low = 0;
  while (low < size && byte_of(words, low) == std::byte{0}) ++low;
  if (low == size) {
    out.push_back(std::byte{0});
    out.push_back(std::byte{0});
    return;
  }
  std::size_t high = size;
  const std::byte fill = (words.back() >> 63) != 0 ? std::byte{0xff} : std::byte{0};
  const auto top_bit = [](std::byte byte) { return byte & std::byte{0x80}; };
  while (high > low + 1 && byte_of(words, high - 1) == fill &&
         top_bit(byte_of(words, high - 2)) == top_bit(fill)) {
    --high;
  }
  out.push_back(static_cast<std::byte>(low));
  out.push_back(static_cast<std::byte>(high - low));
  for (std::size_t n = low; n < high; ++n) out.push_back(byte_of(words, n));
}

void take_words(std::span<const std::byte>& bytes, std::span<std::uint64_t> words) {
  const auto low = static_cast<std::size_t>(take_byte(bytes));
  const auto length = static_cast<std::size_t>(take_byte(bytes));
  require(low + length <= words.size() * 8, "partial sums of the right width");
  std::fill(words.begin(), words.end(), 0);
  std::byte last{0};
  for (std::size_t n = low; n < low + length; ++n) {
    last = take_byte(bytes);
    words[n / 8] |= static_cast<std::uint64_t>(last) << (n % 8 * 8);
  }
  if ((last & std::byte{0x80}) == std::byte{0}) return;
  for (std::size_t n = low + length; n < words.size() * 8; ++n)
    words[n / 8] |= std::uint64_t{0xff} << (n % 8 * 8);
}

void put_float(float value, std::vector<std::byte>& out) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (int shift = 0; shift < 32; shift += 8) out.push_back(static_cast<std::byte>(bits >> shift));
}

float take_float(std::span<const std::byte>& bytes) {
  std::uint32_t bits = 0;
  for (int shift = 0; shift < 32; shift += 8) bits |= static_cast<std::uint32_t>(take_byte(bytes)) << shift;
  return std::bit_cast<float>(bits);
}

void put_sum(Int128 value, std::vector<std::byte>& out) {
  const auto bits = static_cast<UInt128>(value);
  const std::uint64_t words[2] = {static_cast<std::uint64_t>(bits), static_cast<std::uint64_t>(bits >> 64)};
  put_words(words, out);
}

Int128 take_sum(std::span<const std::byte>& bytes) {
  std::uint64_t words[2];
  take_words(bytes, words);
  return static_cast<Int128>((static_cast<UInt128>(words[1]) << 64) | words[0]);
}

}  // namespace

void encode(std::int64_t face, const Partial& partial, std::vector<std::byte>& out) {
  put_number(static_cast<std::uint64_t>(face), out);
  const Moments& moments = partial.moments;
  put_number(static_cast<std::uint64_t>(moments.count), out);
  put_number(static_cast<std::uint64_t>(moments.nulls), out);
  if (moments.count > 0) {
    put_float(moments.min, out);
    put_float(moments.max, out);
    put_words(moments.sum.words(), out);
    put_words(moments.squares.words(), out);
  }
  put_sum(partial.discontinuity.den, out);
  if (partial.discontinuity.den != 0) put_sum(partial.discontinuity.num, out);
}

std::size_t most_bytes(bool with_discontinuity) {
  constexpr std::size_t kNumber = 10;  // bytes of a 64-bit number, 7 bits each
  constexpr std::size_t kSumHead = 2;
  constexpr std::size_t kSum = kSumHead + sizeof(Int128);
  constexpr std::size_t kMoments =
      2 * sizeof(float) + 2 * kSumHead + 8 * WideInteger<5>::kWords + 8 * WideInteger<10>::kWords;
  return 3 * kNumber + kMoments + (with_discontinuity ? 2 * kSum : kSumHead);
}

std::int64_t decode(std::span<const std::byte>& bytes, Partial& partial) {
  partial = {};
  const auto face = static_cast<std::int64_t>(take_number(bytes));
  Moments& moments = partial.moments;
  moments.count = static_cast<std::int64_t>(take_number(bytes));
  moments.nulls = static_cast<std::int64_t>(take_number(bytes));
  if (moments.count > 0) {
    moments.min = take_float(bytes);
    moments.max = take_float(bytes);
    take_words(bytes, moments.sum.words());
    take_words(bytes, moments.squares.words());
  }
  partial.discontinuity.den = take_sum(bytes);
  if (partial.discontinuity.den != 0) partial.discontinuity.num = take_sum(bytes);
  return face;
}

FaceStatistics finish(const Partial& partial, bool inside_survey) {
  const Moments& moments = partial.moments;
  FaceStatistics face;
  face.count = moments.count;
  face.nulls = moments.nulls;
  face.outside = inside_survey          ? Outside::kInside
                 : partial.voxels() > 0 ? Outside::kPartly
                                        : Outside::kWholly;
  face.mean = moments.mean();
  face.variance = moments.variance();
  if (moments.count > 0) {
    face.min = moments.min;
    face.max = moments.max;
  }
  face.discontinuity = partial.discontinuity.value();
  return face;
}

}  // namespace footwall::extract
