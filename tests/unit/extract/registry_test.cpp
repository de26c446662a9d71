#include "engine/extract/registry.h"

#include <gtest/gtest.h>

#include "storage/base/error.h"

namespace footwall::extract {
namespace {

TEST(Registry, FindsWhatIsBuilt) {
  EXPECT_EQ(find_row(exchange_rows(), "exchange", "reduce").name, "reduce");
  EXPECT_EQ(find_row(balance_rows(), "balance", "none").name, "none");
  EXPECT_EQ(find_row(voxelizer_rows(), "voxelizer", "exact").name, "exact");
}

TEST(Registry, RefusesTheRestAsWrongUsageAndListsTheChoice) {
  for (const char* name : {"pushing", "sideways", ""}) {
    try {
      find_row(exchange_rows(), "exchange", name);
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kUsage);
      EXPECT_NE(error.message().find("exchange"), std::string::npos);
    }
  }
  try {
    find_row(exchange_rows(), "exchange", "sideways");
  } catch (const Error& error) {
    EXPECT_NE(error.hint().find("reduce"), std::string::npos);
    EXPECT_NE(error.hint().find("push"), std::string::npos);
  }
}

TEST(Registry, RefusesParametersThatAStrategyDoesNotTake) {
  for (const char* exchange :
       {"reduce=3", "minimum=2", "push=1", "bounding=2", "block=0", "block=x", "block=2,3"}) {
    Options options;
    options.exchange = exchange;
    EXPECT_THROW(validate(options), Error) << exchange;
  }
  Options options;
  options.balance = "none=1";
  EXPECT_THROW(validate(options), Error);
  options.balance = "none";
  options.voxelizer = "exact=1";
  EXPECT_THROW(validate(options), Error);
  options.voxelizer = "exact";
  EXPECT_NO_THROW(validate(options));
}

}  // namespace
}  // namespace footwall::extract
