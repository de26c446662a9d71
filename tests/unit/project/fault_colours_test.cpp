#include "storage/project/fault_colours.h"

#include <gtest/gtest.h>

#include <set>

namespace footwall::project {
namespace {

TEST(FaultColours, AreDifferentAsLongAsThereAreSome) {
  FaultColours colours({});
  std::set<std::string> given;
  for (int n = 0; n < 10; ++n) given.insert(colours.next());
  EXPECT_EQ(given.size(), 10U);
  EXPECT_TRUE(given.contains(colours.next()));  // the first one again
}

TEST(FaultColours, ThoseThatFewestFaultsHaveComeFirst) {
  const std::string first = FaultColours({}).next();
  FaultRecord fault;
  fault.colour = first;
  FaultRecord other;
  other.colour = "#010203";  // chosen by hand
  const std::vector<FaultRecord> faults{fault, other};
  EXPECT_NE(FaultColours(faults).next(), first);
  EXPECT_NE(FaultColours(faults).next(), other.colour);
}

}  // namespace
}  // namespace footwall::project
