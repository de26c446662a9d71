#include "engine/extract/lapped/band_coder.h"

#include <bit>
#include <cstring>
#include <iterator>

#include "engine/extract/lapped/expected_magnitude.h"
#include "storage/base/error.h"

namespace footwall::extract::lapped {
namespace {

constexpr std::uint32_t kLeastState = 1U << 15;  // states lie in [2^15, 2^31)
constexpr std::uint32_t kTokenBits = 6;
static_assert(kTokens <= 1U << kTokenBits);
static_assert(std::endian::native == std::endian::little);

// What encoding one token needs, without a division: x / frequency is (x * reciprocal) >> shift for every
// state x.
struct Step {
  std::uint32_t most;  // a state from here on gives off a word first
  std::uint32_t reciprocal;
  std::uint32_t bias;
  std::uint16_t complement;  // 2^14 - frequency
  std::uint16_t shift;
};

using Steps = std::array<Step, kClasses << kTokenBits>;

Step step_of(std::uint32_t start, std::uint32_t frequency) {
  constexpr std::uint32_t kWhole = 1U << kFrequencyBits;
  Step step{};
  step.most = frequency << (31 - kFrequencyBits);
  step.complement = static_cast<std::uint16_t>(kWhole - frequency);
  if (frequency == 1) {
    // x / 1 as (x * (2^32 - 1)) >> 32, which is x - 1; the bias puts it right.
    step.reciprocal = ~std::uint32_t{0};
    step.shift = 32;
    step.bias = start + kWhole - 1;
    return step;
  }
  const auto bits = static_cast<std::uint32_t>(std::bit_width(frequency - 1));
  step.reciprocal =
      static_cast<std::uint32_t>(((std::uint64_t{1} << (bits + 31)) + frequency - 1) / frequency);
  step.shift = static_cast<std::uint16_t>(bits + 31);
  step.bias = start;
  return step;
}

Steps make_steps() {
  Steps steps{};
  for (std::uint32_t c = 0; c < kClasses; ++c) {
    const Shares& starts = shares_of(c);
    for (std::size_t token = 0; token < kTokens; ++token) {
      steps[(c << kTokenBits) + token] =
          step_of(starts[token], std::uint32_t{starts[token + 1]} - starts[token]);
    }
  }
  return steps;
}

const Steps& steps() {
  static const Steps table = make_steps();
  return table;
}

using SmallTokens = std::array<Token, 256>;
const SmallTokens& small_tokens() {
  static constexpr SmallTokens kTable = [] {
    SmallTokens table{};
    for (std::uint32_t n = 0; n < table.size(); ++n) table[n] = token_of(n);
    return table;
  }();
  return kTable;
}

std::uint32_t size_of(std::int32_t value) {
  return static_cast<std::uint32_t>(value < 0 ? -value : value);
}

void append_word(std::uint32_t word, std::vector<std::byte>& out) {
  out.push_back(static_cast<std::byte>(word & 0xff));
  out.push_back(static_cast<std::byte>(word >> 8 & 0xff));
}

[[noreturn]] void corrupt(const char* why) {
  throw Error(ErrorCode::kCorrupt, std::string("the code of a face's voxels ") + why,
              "compute the run again: extract --compute lot");
}

}  // namespace

void BandEncoder::clear() {
  symbols_.clear();
  used_ = 0;
  pending_ = 0;
  pending_bits_ = 0;
}

void BandEncoder::add_line(std::span<const std::int32_t> coefficients) {
  expected_magnitudes(coefficients, expected_);
  add(coefficients);
}

void BandEncoder::add_tiles(std::span<const Tile> tiles, std::span<const std::int32_t> coefficients) {
  expected_magnitudes(tiles, coefficients, magnitudes_, expected_);
  add(coefficients);
}

void BandEncoder::add(std::span<const std::int32_t> coefficients) {
  const std::size_t first = symbols_.size();
  symbols_.resize(first + coefficients.size());
  // At most 23 bits each, and the last store reaches 8 bytes ahead.
  if (bits_.size() < used_ + 3 * coefficients.size() + 16) bits_.resize(used_ + 6 * coefficients.size() + 16);
  const std::uint8_t* const of_class = classes().data();
  const SmallTokens& small = small_tokens();
  std::uint16_t* symbol = symbols_.data() + first;
  std::byte* out = bits_.data() + used_;
  std::uint64_t pending = pending_;
  std::uint32_t pending_bits = pending_bits_;
  for (std::size_t n = 0; n < coefficients.size(); ++n) {
    const std::int32_t value = coefficients[n];
    const std::uint32_t sign = value < 0 ? 1 : 0;
    const std::uint32_t magnitude = static_cast<std::uint32_t>(value < 0 ? -value : value);
    const Token token = magnitude < small.size() ? small[magnitude] : token_of(magnitude);
    symbol[n] = static_cast<std::uint16_t>(std::uint32_t{of_class[expected_[n]]} << kTokenBits | token.token);
    // The extra bits, and above them the sign of what is not 0.
    const std::uint32_t extra = magnitude & ((1U << token.extra_bits) - 1);
    pending |= std::uint64_t{extra | sign << token.extra_bits} << pending_bits;
    pending_bits += token.extra_bits + (magnitude != 0 ? 1 : 0);
    std::memcpy(out, &pending, sizeof pending);
    out += pending_bits / 8;
    pending >>= pending_bits / 8 * 8;
    pending_bits %= 8;
  }
  used_ = static_cast<std::size_t>(out - bits_.data());
  pending_ = pending;
  pending_bits_ = pending_bits;
}

void BandEncoder::finish(std::vector<std::byte>& out) {
  // From the last symbol to the first: the decoder then meets them in order. One word at most per symbol.
  words_.resize(symbols_.size());
  std::uint16_t* const end = words_.data() + words_.size();
  std::uint16_t* word = end;
  std::uint32_t state[2] = {kLeastState, kLeastState};
  const Step* table = steps().data();
  for (std::size_t n = symbols_.size(); n-- > 0;) {
    const Step& step = table[symbols_[n]];
    std::uint32_t x = state[n % 2];
    const bool full = x >= step.most;
    word[-1] = static_cast<std::uint16_t>(x);
    word -= full ? 1 : 0;
    x >>= full ? 16 : 0;
    const auto quotient = static_cast<std::uint32_t>((std::uint64_t{x} * step.reciprocal) >> step.shift);
    state[n % 2] = x + step.bias + quotient * step.complement;
  }
  for (const std::uint32_t x : state) {
    append_word(x, out);
    append_word(x >> 16, out);
  }
  for (; word != end; ++word) append_word(*word, out);
  if (pending_bits_ > 0) out.push_back(static_cast<std::byte>(pending_));
  const auto written = bits_.begin() + static_cast<std::ptrdiff_t>(used_);
  std::reverse_copy(bits_.begin(), written, std::back_inserter(out));
}

BandDecoder::BandDecoder(std::span<const std::byte> code) : code_(code), back_(code.size()) {
  if (code.size() < 2 * sizeof(std::uint32_t)) corrupt("ends too early");
  for (std::uint32_t& state : state_) {
    for (int byte = 0; byte < 4; ++byte) {
      state |= std::to_integer<std::uint32_t>(code_[front_++]) << (8 * byte);
    }
    if (state < kLeastState || state >= 1U << 31) corrupt("begins with no state of the coder");
  }
}

std::uint32_t BandDecoder::plain_bits(std::uint32_t count) {
  while (pending_bits_ < count) {
    if (back_ == front_) corrupt("ends too early");
    pending_ |= std::to_integer<std::uint64_t>(code_[--back_]) << pending_bits_;
    pending_bits_ += 8;
  }
  const auto bits = static_cast<std::uint32_t>(pending_ & ((std::uint64_t{1} << count) - 1));
  pending_ >>= count;
  pending_bits_ -= count;
  return bits;
}

std::int32_t BandDecoder::next(std::uint32_t expected) {
  const Shares& starts = shares_of(class_of(expected));
  std::uint32_t& x = state_[turn_];
  turn_ ^= 1;
  const std::uint32_t slot = x & ((1U << kFrequencyBits) - 1);
  const auto above = std::upper_bound(starts.begin(), starts.end(), slot);
  const auto token = static_cast<std::uint32_t>(above - starts.begin()) - 1;
  x = (std::uint32_t{starts[token + 1]} - starts[token]) * (x >> kFrequencyBits) + slot - starts[token];
  if (x < kLeastState) {
    if (front_ + 2 > back_) corrupt("ends too early");
    x = x << 16 | std::to_integer<std::uint32_t>(code_[front_]) |
        std::to_integer<std::uint32_t>(code_[front_ + 1]) << 8;
    front_ += 2;
  }
  const std::uint32_t magnitude = first_of(token) + plain_bits(extra_bits_of(token));
  if (magnitude == 0) return 0;
  const auto value = static_cast<std::int32_t>(magnitude);
  return plain_bits(1) != 0 ? -value : value;
}

void BandDecoder::read_line(std::span<std::int32_t> coefficients) {
  walk<1>(
      coefficients.size() / kBands,
      [](std::size_t b) { return b == 0 ? Tile::kNone : static_cast<std::uint32_t>(b - 1); },
      [](std::size_t) { return Tile::kNone; }, magnitudes_,
      [&](std::size_t n, std::uint32_t expected) { return size_of(coefficients[n] = next(expected)); });
}

void BandDecoder::read_tiles(std::span<const Tile> tiles, std::span<std::int32_t> coefficients) {
  require(coefficients.size() == tiles.size() * kSquare, "64 coefficients of every tile");
  walk<kBands>(
      tiles.size(), [&](std::size_t n) { return tiles[n].left; },
      [&](std::size_t n) { return tiles[n].above; }, magnitudes_,
      [&](std::size_t n, std::uint32_t expected) { return size_of(coefficients[n] = next(expected)); });
}

void BandDecoder::end() const {
  if (front_ != back_) corrupt("has bytes to spare");
  if (state_[0] != kLeastState || state_[1] != kLeastState || pending_ != 0)
    corrupt("does not end as it should");
}

}  // namespace footwall::extract::lapped
