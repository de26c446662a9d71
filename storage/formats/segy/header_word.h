// Where a trace header has a number, and how it is coded: "189", "81:ieee", "193:int16", "none", "order".
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace footwall::formats::segy {

enum class WordType : std::uint8_t {
  kInt32,
  kInt16,
  kIeee,     // IEEE float32
  kIbm,      // IBM float32
  kFloat64,  // IEEE float64
  kNone,     // the header does not have it: line 1, or no coordinate
  kOrder     // the trace's place in the file, from 1: for lines whose traces have no number
};

struct HeaderWord {
  int byte = 0;  // from 1; 241 is the first byte of the additional trace header; 0 for kNone and kOrder
  WordType type = WordType::kInt32;

  constexpr HeaderWord() = default;
  // Implicit, because a plain byte number is what is nearly always meant.
  constexpr HeaderWord(int at, WordType as = WordType::kInt32) : byte(at), type(as) {}
  friend bool operator==(const HeaderWord&, const HeaderWord&) = default;
};

inline constexpr HeaderWord kNoWord{0, WordType::kNone};
inline constexpr HeaderWord kOrderWord{0, WordType::kOrder};

// Bytes of a number of this type, 0 for kNone and kOrder.
int size_of(WordType type);
// False where a coordinate scalar does not apply: floating point words are in full units already.
bool is_scaled(WordType type);

// Throws kUsage, naming the option, for anything but the forms above.
HeaderWord header_word_from(std::string_view text, std::string_view option);
// The inverse.
std::string text_of(const HeaderWord& word);

// The number; header: the trace's header bytes, which hold the whole word; trace: its place in the file from
// 0.
double value_of(const HeaderWord& word, std::span<const std::byte> header, bool swap, std::int64_t trace);

}  // namespace footwall::formats::segy
