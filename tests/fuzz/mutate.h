// Damaged inputs: the same seed and round give the same bytes on every machine.
#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace footwall::fuzz {

// One input for a round: one of `originals`, changed at one to eight places. Bits are flipped, bytes and
// words set to values at the edge of their range, parts cut out, doubled, moved, taken from another original,
// or the end cut off; in text, numbers and words are exchanged too. At most max_size bytes. originals must
// not be empty.
std::string mutated(std::span<const std::string> originals, std::uint64_t seed, std::uint64_t round,
                    std::size_t max_size = std::size_t{1} << 20);

}  // namespace footwall::fuzz
