#include "storage/base/error.h"

#include <gtest/gtest.h>

#include <cerrno>

namespace footwall {
namespace {

TEST(Error, SaysWhatHappenedAndHowToMendIt) {
  const Error error(ErrorCode::kNotFound, "there is no fault 'F9'", "footwall faults lists them");
  EXPECT_EQ(error.message(), "there is no fault 'F9'");
  EXPECT_EQ(error.hint(), "footwall faults lists them");
  EXPECT_STREQ(error.what(), "there is no fault 'F9' (footwall faults lists them)");
}

TEST(Error, EveryCodeHasANameThatReadsBack) {
  for (int code = 0; code <= static_cast<int>(ErrorCode::kInternal); ++code) {
    const auto value = static_cast<ErrorCode>(code);
    EXPECT_EQ(error_code_from(name_of(value)), value) << name_of(value);
  }
}

TEST(Error, RequireThrowsWithTheCallersPlace) {
  EXPECT_NO_THROW(require(true, "fine"));
  try {
    require(false, "a broken promise");
    FAIL() << "require(false) must throw";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInternal);
    EXPECT_NE(error.message().find("error_test.cpp"), std::string::npos);
  }
}

TEST(Error, AFullDiskIsNamedWithItsRemedy) {
  const Error error = io_error("write", "/data/a.h5", ENOSPC);
  EXPECT_EQ(error.code(), ErrorCode::kIo);
  EXPECT_NE(error.hint().find("space"), std::string::npos);
}

}  // namespace
}  // namespace footwall
