#include "engine/synthetic/registry.h"

#include <gtest/gtest.h>

#include "storage/base/error.h"

namespace footwall::synthetic {
namespace {

TEST(Registry, MakesEveryKindItLists) {
  Options options;
  options.size = {20, 20, 20};
  for (const SurveyKind& kind : survey_kinds()) {
    EXPECT_EQ(make_survey(kind.name, options).geometry().dims(), options.size) << kind.name;
    EXPECT_FALSE(kind.help.empty());
  }
}

TEST(Registry, UnknownNameIsRefusedWithTheNamesThereAre) {
  try {
    make_survey("folded", {});
    FAIL() << "made a survey of an unknown kind";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kUsage);
    EXPECT_NE(error.message().find("folded"), std::string::npos);
    EXPECT_NE(error.hint().find("faulted"), std::string::npos);
  }
}

}  // namespace
}  // namespace footwall::synthetic
