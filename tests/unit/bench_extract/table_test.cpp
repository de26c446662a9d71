#include "engine/tasks/bench_extract/table.h"

#include <gtest/gtest.h>

#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

TEST(Table, AlignsOrMarks) {
  const Table table{"Title", {"name", "s"}, {{"a", "1.5"}, {"longer", "12"}}};
  EXPECT_EQ(to_text(table), "Title\nname      s\na       1.5\nlonger   12\n\n");
  EXPECT_EQ(to_markdown(table), "**Title**\n\n| name | s |\n|---|--:|\n| a | 1.5 |\n| longer | 12 |\n\n");
  EXPECT_THROW(to_text({"x", {"one"}, {{"1", "2"}}}), Error);
}

}  // namespace
}  // namespace footwall::tasks
