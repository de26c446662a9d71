#include "engine/tasks/statistics.h"

#include <gtest/gtest.h>

#include <set>

#include "engine/extract/face_numbers.h"

namespace footwall::tasks {
namespace {

TEST(Statistics, EveryNumberOfAFaceHasAColumn) {
  std::set<std::string> names;
  for (const project::StatisticRecord& record : stored_statistics()) names.insert(record.name);
  for (const extract::FaceNumber& each : extract::kFaceNumbers) {
    EXPECT_TRUE(names.contains(std::string(each.name))) << each.name;
  }
}

TEST(Statistics, ColumnsHoldTheNumbersOfTheFaces) {
  session::Part part;
  part.faces.resize(2);
  part.statistics.resize(2);
  part.geometry.resize(2);
  part.geometry[1].metres_along_normal = 25;
  for (const extract::FaceNumber& each : extract::kFaceNumbers) {
    part.statistics[0].*each.member = 1;
    part.statistics[1].*each.member = 3;
  }
  const auto columns = columns_of(part);
  for (const extract::FaceNumber& each : extract::kFaceNumbers) {
    EXPECT_EQ(columns.at(std::string(each.name)), (std::vector<double>{1, 3})) << each.name;
  }
  EXPECT_EQ(columns.at("offset")[1], 75);
}

}  // namespace
}  // namespace footwall::tasks
