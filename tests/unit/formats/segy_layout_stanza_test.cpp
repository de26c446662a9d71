#include "storage/formats/segy/layout_stanza.h"

#include <gtest/gtest.h>

namespace footwall::formats::segy {
namespace {

TEST(SegyLayoutStanza, EntriesSayWhereWordsAre) {
  const auto found = find_layout_stanza(
      "((OGP: other)) byte=\"9\" (( seg : LAYOUT:text/xml ))\n<segy-layout name=\"mine\">"
      "<entry name=\"iline\" byte=\"190\" type=\"int4\"/> <entry byte=\"5\" type=\"uint2\" name=\"xline\"/>"
      "<entry name=\"cdp_x\" byte=\"81\" type=\"ieee32\"/><entry name=\"cdp_y\" byte=\"239\" type=\"coor4\"/>"
      "<extension name=\"SEG00001\"><entry name=\"cdp_x\" byte=\"161\" type=\"ieee64\"/></extension>"
      "<entry name=\"offset\" byte=\"37\" type=\"int4\"/></segy-layout>");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->name, "mine");
  EXPECT_EQ(found->inline_word, HeaderWord(190));
  EXPECT_EQ(found->crossline_word, HeaderWord(5, WordType::kInt16));
  EXPECT_EQ(found->x, HeaderWord(81, WordType::kIeee));
  EXPECT_FALSE(found->y);  // would not fit
  EXPECT_EQ(found->offset, HeaderWord(37));
}

TEST(SegyLayoutStanza, NothingInOtherTextOrBrokenXml) {
  for (const char* text :
       {"", "((", "((SEG:Layout", "((SEG:Layout))",
        "((SEG:Layout))<entry name=\"iline\" byte=\"x\" type=\"int4\"/>",
        "((SEG:Layout))<entry name=\"iline\" byte=\"1\" type=\"int4\"",
        "((SEG:Layout))<entry name=", "((SEG:Layout))<entry name=\"iline\" byte=\"-1\" type=\"int4\"/>",
        "<entry name=\"iline\" byte=\"1\" type=\"int4\"/>"}) {
    EXPECT_FALSE(find_layout_stanza(text)) << text;
  }
}

}  // namespace
}  // namespace footwall::formats::segy
