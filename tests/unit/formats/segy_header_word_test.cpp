#include "storage/formats/segy/header_word.h"

#include <gtest/gtest.h>

#include <array>

#include "storage/base/error.h"
#include "storage/formats/segy/presets.h"

namespace footwall::formats::segy {
namespace {

TEST(SegyHeaderWord, TextAndBack) {
  for (const char* text : {"189", "81:ieee", "85:ibm", "193:int16", "401:float64", "none", "order"}) {
    EXPECT_EQ(text_of(header_word_from(text, "--x-byte")), text);
  }
  EXPECT_EQ(header_word_from("7:int32", "--x-byte"), HeaderWord(7));
}

TEST(SegyHeaderWord, WrongTextsNameTheOption) {
  for (const char* text :
       {"", "0", "-4", "481", "12:", "12:float", "x", "12 13", "99999999999999999999", "1:ieee:2"}) {
    try {
      header_word_from(text, "--y-byte");
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kUsage);
      EXPECT_NE(error.message().find("--y-byte"), std::string::npos);
    }
  }
}

TEST(SegyHeaderWord, EveryTypeInBothByteOrders) {
  const std::array big{std::byte{0xC2}, std::byte{0xED}, std::byte{0x40}, std::byte{0},
                       std::byte{0},    std::byte{0},    std::byte{0},    std::byte{0}};
  EXPECT_EQ(value_of({1, WordType::kIeee}, big, true, 0), -118.625);
  EXPECT_EQ(value_of({1, WordType::kInt16}, big, true, 0), -15635);
  EXPECT_EQ(value_of({2, WordType::kInt16}, big, false, 0), 0x40ED);
  EXPECT_EQ(value_of({1}, big, true, 0), static_cast<std::int32_t>(0xC2ED4000u));
  EXPECT_EQ(value_of({1, WordType::kIbm}, big, true, 0), -237.25);
  EXPECT_NE(value_of({1, WordType::kFloat64}, big, true, 0), 0);
  EXPECT_EQ(value_of(kNoWord, big, true, 7), 0);
  EXPECT_EQ(value_of(kOrderWord, big, true, 7), 8);
}

TEST(SegyHeaderWord, PresetsAreNamedOnce) {
  for (const Preset& preset : presets()) EXPECT_EQ(preset_named(preset.name).help, preset.help);
  EXPECT_THROW(preset_named("rev9"), Error);
}

}  // namespace
}  // namespace footwall::formats::segy
