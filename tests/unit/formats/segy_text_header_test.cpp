#include "storage/formats/segy/text_header.h"

#include <gtest/gtest.h>

namespace footwall::formats::segy {
namespace {

std::vector<std::byte> padded(std::string text, char blank) {
  text.resize(kTextHeaderSize, blank);
  std::vector<std::byte> out;
  for (const char letter : text) out.push_back(static_cast<std::byte>(letter));
  return out;
}

TEST(SegyTextHeader, EbcdicIsDecoded) {
  // "C 1 CLIENT: A_b(9)/" in code page 037
  const auto text =
      padded("\xC3\x40\xF1\x40\xC3\xD3\xC9\xC5\xD5\xE3\x7A\x40\xC1\x6D\x82\x4D\xF9\x5D\x61", '\x40');
  ASSERT_TRUE(is_ebcdic(text));
  const auto lines = text_lines(text, true);
  ASSERT_EQ(lines.size(), 40u);
  EXPECT_EQ(lines[0], "C 1 CLIENT: A_b(9)/");
  EXPECT_EQ(lines[39], "");
}

TEST(SegyTextHeader, AsciiIsToldWhateverItStartsWith) {
  EXPECT_FALSE(is_ebcdic(padded("Processed by nobody, 1999", ' ')));
  EXPECT_FALSE(is_ebcdic(padded("", ' ')));
  EXPECT_TRUE(is_ebcdic(padded("", '\x40')));
}

TEST(SegyTextHeader, ControlCharactersBecomeBlanks) {
  const auto lines = text_lines(padded(std::string("a\0\x1B[2Jb", 7), '\0'), false);
  EXPECT_EQ(lines[0], "a  [2Jb");
}

TEST(SegyTextHeader, EndStanzaIgnoresCaseAndBlanks) {
  EXPECT_TRUE(is_end_stanza(padded("((SEG: EndText))", ' ')));
  EXPECT_TRUE(is_end_stanza(padded("(( seg:  ENDTEXT ))", ' ')));
  EXPECT_FALSE(is_end_stanza(padded("((OGP: P1/90))", ' ')));
}

}  // namespace
}  // namespace footwall::formats::segy
