// Quantized coefficients as bytes: each is expected to be as large as its neighbours (the same band of the
// blocks before, the bands before it in its block), which chooses the table of an asymmetric numeral system
// (rANS); signs and the lower bits of large ones follow as they are.
//
// The bytes: two final states of the coder, 4 bytes each, its 16-bit words, then the plain bits, which are
// read from the last byte backwards; all little-endian.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/extract/lapped/tokens.h"
#include "engine/extract/lapped/transform.h"

namespace footwall::extract::lapped {

class BandEncoder {
 public:
  void clear();
  // The blocks of a line, or of a field of tiles; |coefficient| <= kMostMagnitude.
  void add_line(std::span<const std::int32_t> coefficients);
  void add_tiles(std::span<const Tile> tiles, std::span<const std::int32_t> coefficients);
  // Appends the bytes of all that was added since clear().
  void finish(std::vector<std::byte>& out);

 private:
  void add(std::span<const std::int32_t> coefficients);

  std::vector<std::uint16_t> symbols_;  // class * 64 + token
  std::vector<std::byte> bits_;         // the first used_ bytes, and room
  std::size_t used_ = 0;
  std::uint64_t pending_ = 0;  // fewer than 8 bits between calls
  std::uint32_t pending_bits_ = 0;
  std::vector<std::uint16_t> expected_;
  std::vector<std::int32_t> magnitudes_;
  std::vector<std::uint16_t> words_;
};

// Gives back in the same order what was added. Throws Error kCorrupt where the bytes end too early, are too
// many, or cannot have come from an encoder.
class BandDecoder {
 public:
  explicit BandDecoder(std::span<const std::byte> code);
  void read_line(std::span<std::int32_t> coefficients);
  void read_tiles(std::span<const Tile> tiles, std::span<std::int32_t> coefficients);
  // After the last part: that nothing is left.
  void end() const;

 private:
  std::int32_t next(std::uint32_t expected);
  std::uint32_t plain_bits(std::uint32_t count);

  std::span<const std::byte> code_;
  std::size_t front_ = 0;  // bytes read of the words
  std::size_t back_ = 0;   // bytes not yet read of the plain bits
  std::uint64_t pending_ = 0;
  std::uint32_t pending_bits_ = 0;
  std::uint32_t state_[2] = {0, 0};
  std::uint32_t turn_ = 0;
  std::vector<std::uint8_t> magnitudes_;
};

}  // namespace footwall::extract::lapped
