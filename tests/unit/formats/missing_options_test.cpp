#include "storage/formats/missing_options.h"

#include <gtest/gtest.h>

#include "storage/base/error.h"

namespace footwall::formats {
namespace {

std::string said(const std::vector<MissingOption>& missing) {
  try {
    refuse_missing(missing);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kUsage);
    return error.message() + "; " + error.hint();
  }
  return "";
}

TEST(MissingOptions, AreNamedInOneSentence) {
  EXPECT_EQ(said({}), "");
  EXPECT_EQ(
      said({kMissingUnit}),
      "--vertical-unit is missing: the file cannot tell the unit of z; add --vertical-unit (ms, m or ft)");
  EXPECT_EQ(
      said({kMissingDomain, kMissingUnit, kMissingInterval}),
      "--domain, --vertical-unit and --interval are missing: the file cannot tell whether z is time or "
      "depth, the unit of z or the sample interval; add --domain (time or depth), --vertical-unit (ms, m "
      "or ft), --interval (a number in the vertical unit, e.g. 4)");
}

}  // namespace
}  // namespace footwall::formats
