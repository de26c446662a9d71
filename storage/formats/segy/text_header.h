// Textual headers: 40 lines of 80 columns in EBCDIC or ASCII.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace footwall::formats::segy {

inline constexpr std::size_t kTextHeaderSize = 3200;

// Decides by scoring all bytes in both code pages; one look at the first byte is wrong for ASCII text that
// does not start with 'C'.
bool is_ebcdic(std::span<const std::byte> text);
// One byte, as printable ASCII; what has no ASCII form becomes a blank.
char decoded(std::byte character, bool ebcdic);
// Lines of 80 columns, trailing blanks removed.
std::vector<std::string> text_lines(std::span<const std::byte> text, bool ebcdic);
// True for the block that ends extended headers of unknown number: stanza ((SEG: EndText)), blanks and case
// ignored.
bool is_end_stanza(std::span<const std::byte> text);

}  // namespace footwall::formats::segy
