#include "storage/formats/face_values_csv.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "storage/base/error.h"

namespace footwall::formats::face_values_csv {
namespace {

std::vector<FaceValue> read_text(const std::string& text, const std::string& name = "throw") {
  std::istringstream in(text);
  return read(in, name);
}

Error error_of(const std::string& text) {
  try {
    read_text(text);
  } catch (const Error& error) {
    return error;
  }
  return {ErrorCode::kInternal, "no error"};
}

TEST(FaceValuesCsv, FindsItsColumnsByName) {
  const auto rows = read_text(
      "\xEF\xBB\xBF"
      "fault,count,throw,face\r\n\"F, 1\",7,-2.5,3-7.12\r\n\r\nF2,8,,\"1.0\"\r\n");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].fault, "F, 1");
  EXPECT_EQ(rows[0].face, "3-7.12");
  EXPECT_EQ(rows[0].value, -2.5);
  EXPECT_EQ(rows[0].line, 2);
  EXPECT_EQ(rows[1].face, "1.0");
  EXPECT_TRUE(std::isnan(rows[1].value));
  EXPECT_EQ(rows[1].line, 4);
}

TEST(FaceValuesCsv, TakesValueWithoutAFault) {
  const auto rows = read_text("face,value\n\"a \"\"b\"\"\",nan\n2.1,1e3");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].face, "a \"b\"");
  EXPECT_TRUE(rows[0].fault.empty());
  EXPECT_EQ(rows[1].value, 1000);
}

TEST(FaceValuesCsv, NamesTheLineThatCannotBeUsed) {
  for (const char* text : {"", "1.0,5\n", "face,other\n1.0,5\n"})
    EXPECT_EQ(error_of(text).code(), ErrorCode::kFormat);
  const std::string head = "face,value\n1.0,1\n";
  for (const char* row : {"1.1\n", ",3\n", "1.1,inf\n", "1.1,x\n", "1.1,1e999\n", "\"1.1,3\n"}) {
    const Error error = error_of(head + row);
    EXPECT_EQ(error.code(), ErrorCode::kInvalid) << row;
    EXPECT_TRUE(error.message().starts_with("line 3: ")) << error.message();
  }
}

}  // namespace
}  // namespace footwall::formats::face_values_csv
