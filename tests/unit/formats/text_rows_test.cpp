#include "storage/formats/detail/text_rows.h"

#include <gtest/gtest.h>

namespace footwall::formats::detail {
namespace {

std::vector<std::string> rows_of(std::string_view text) {
  std::vector<std::string> found;
  for (Rows rows(text); rows.next();) found.emplace_back(rows.row());
  return found;
}

TEST(TextRows, EndWithLfCrLfOrCr) {
  const std::vector<std::string> expected{"a", "", "b"};
  EXPECT_EQ(rows_of("a\n\nb"), expected);
  EXPECT_EQ(rows_of("\xEF\xBB\xBF"
                    "a\r\n\r\nb\r\n"),
            expected);
  EXPECT_EQ(rows_of("a\r\rb\r"), expected);
  EXPECT_TRUE(rows_of("").empty());
  EXPECT_EQ(rows_of(std::string_view("a\0b\nc", 5)), (std::vector<std::string>{std::string("a\0b", 3), "c"}));
}

using Split = std::vector<std::pair<std::string, std::size_t>>;
Split split(std::string_view row, char delimiter) {
  std::vector<Field> fields;
  split_fields(row, delimiter, fields);
  Split found;
  for (const Field& field : fields) found.emplace_back(field.text, field.at);
  return found;
}

TEST(TextRows, FieldsHaveTheirPlaces) {
  EXPECT_EQ(split("  1\t22  x ", 0), (Split{{"1", 2}, {"22", 4}, {"x", 8}}));
  EXPECT_EQ(split("1, ,3,", ','), (Split{{"1", 0}, {"", 3}, {"3", 4}, {"", 6}}));
  EXPECT_EQ(split("\ta\t b", '\t'), (Split{{"", 0}, {"a", 1}, {"b", 4}}));
  EXPECT_EQ(split("", ','), (Split{{"", 0}}));
  EXPECT_TRUE(split(" \t", 0).empty());
}

TEST(TextRows, QuotesHoldAFieldTogether) {
  EXPECT_EQ(split("\"F 1\" 2", 0), (Split{{"F 1", 1}, {"2", 6}}));
  EXPECT_EQ(split("'a, b' ,2", ','), (Split{{"a, b", 1}, {"2", 8}}));
  EXPECT_EQ(split("\"open 2", 0), (Split{{"\"open", 0}, {"2", 6}}));
  EXPECT_EQ(split("D'Arcy 2'", 0), (Split{{"D'Arcy", 0}, {"2'", 7}}));
  EXPECT_EQ(split("\"\" 2", 0), (Split{{"", 1}, {"2", 3}}));
}

TEST(TextRows, FixedColumnsOfShortRows) {
  EXPECT_EQ(columns_of("abc 12 ", 4, 7).text, "12");
  EXPECT_EQ(columns_of("abc 12 ", 4, 7).at, 4U);
  EXPECT_EQ(columns_of("abc", 3, 9).text, "c");
  EXPECT_EQ(columns_of("abc", 9, 12).text, "");
}

TEST(TextRows, NumbersSayWhatIsWrong) {
  const auto reason = [](std::string_view word) -> std::string {
    try {
      integer_of({word, 7}, "stick number");
    } catch (const RowError& why) {
      EXPECT_EQ(why.at, 7U);
      return why.reason;
    }
    return "";
  };
  EXPECT_EQ(reason("x"), "'x' is no stick number");
  EXPECT_EQ(reason("1.5"), "'1.5' is no stick number");
  EXPECT_EQ(reason(""), "the stick number is missing");
  EXPECT_EQ(reason("nan"), "'nan' is no stick number");
  EXPECT_EQ(reason("-1e30"), "the stick number is a null value");
  EXPECT_EQ(integer_of({"+7.0", 0}, "stick number"), 7);
  EXPECT_LT(reason(std::string(5000, '9') + "x").size(), 100U);
}

TEST(TextRows, CommentsAreNotNegativeNumbers) {
  for (const char* comment : {"# x", "  ! x", "// x", "-- x"}) EXPECT_TRUE(is_comment(comment)) << comment;
  for (const char* row : {"", "1 #", "-5 2", "--5", "/ x"}) EXPECT_FALSE(is_comment(row)) << row;
}

}  // namespace
}  // namespace footwall::formats::detail
