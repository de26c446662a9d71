#include "engine/tasks/workload/script.h"

#include <gtest/gtest.h>

#include <sstream>

#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

const Workload kEverything{
    {10, 20, 30},
    {{{{{mesh::CreateMesh{{{0, 0, 0}, {256, 0, 0}, {0, 256, -7}}, {{0, 1, 2}}},
         mesh::AddFace{0, 0, mesh::LatticePoint{1, 2, 3}}, mesh::AddFace{0, 3, mesh::VertexId{2}}},
        true},
       {{mesh::MoveVertex{0, 1, {5, 6, 7}}, mesh::SplitEdge{0, 2, {8, 9, 10}}}, true},
       {{}, true},
       {{mesh::RemoveFace{0, 1}, mesh::RemoveFaces{0, 2}, mesh::DestroyMesh{0}}, false}}},
     {{}}}};

std::string text_of(const Workload& workload) {
  std::ostringstream out;
  write_script_head(workload.size, "two lines\nof words", out);
  for (const WorkloadRepeat& repeat : workload.repeats) {
    write_script_repeat(out);
    for (const WorkloadStep& step : repeat.steps) write_script_step(step, out);
  }
  return out.str();
}

std::string message_of(const std::string& lines) {
  try {
    parse_script("footwall-workload 1\n" + lines);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kFormat);
    return error.message();
  }
  return "no error";
}

TEST(Script, ComesBackAsItWasWritten) {
  EXPECT_EQ(parse_script(text_of(kEverything)), kEverything);
}

TEST(Script, TakesLinesOfOtherSystemsAndComments) {
  EXPECT_EQ(parse_script("footwall-workload 1\r\nsize 4 5 6\r\n\r\n# words\r\nrepeat # more\r\nextract\r\n"),
            (Workload{{4, 5, 6}, {{{{{}, true}}}}}));
}

TEST(Script, CountsAsTheSeedDoes) {
  const OperationCounts counts = counts_of(kEverything);
  EXPECT_EQ(counts.adds(), 3);
  EXPECT_EQ(counts.remove_faces, 1);
  EXPECT_EQ(counts.remove_face, 1);
  EXPECT_EQ(counts.move_vertex, 1);
  EXPECT_EQ(counts.split_edge, 1);
  EXPECT_EQ(counts.destroy_mesh, 1);
  EXPECT_EQ(counts.extract_all, 3);
}

TEST(Script, TellsTheLineThatIsWrong) {
  EXPECT_THROW(parse_script("size 1 1 1\n"), Error) << "not a workload";
  EXPECT_EQ(message_of("size 4 5 0\n"), "line 2: a survey cannot have 0 voxels along an axis");
  EXPECT_EQ(message_of(""), "line 2: the script ends before it tells the survey's size");
  EXPECT_EQ(message_of("repeat\n"), "line 2: the first line should be 'size INLINES CROSSLINES SAMPLES'");
  EXPECT_EQ(message_of("size 4 5 6\nextract\n"), "line 3: the operations should follow a line 'repeat'");
  const auto in_repeat = [](const std::string& line) { return message_of("size 4 5 6\nrepeat\n" + line); };
  EXPECT_EQ(in_repeat("grow 1\n"), "line 4: 'grow' is no operation");
  EXPECT_EQ(in_repeat("move 0 1 2 3\n"),
            "line 4: the position along samples should be a whole number, not ''");
  EXPECT_EQ(in_repeat("remove 0 1.5\n"), "line 4: the vertex should be a whole number, not '1.5'");
  EXPECT_EQ(in_repeat("remove 0 99999999999\n"),
            "line 4: the vertex should be a whole number, not '99999999999'");
  EXPECT_EQ(in_repeat("destroy 0 1\n"), "line 4: nothing should follow here, but '1' does");
  EXPECT_EQ(in_repeat("create 4000000000 4000000000 1 2 3\n"), "line 4: the line holds fewer numbers");
  EXPECT_EQ(in_repeat("create 1 1 1 2 3 0 0\n"), "line 4: a face's vertex should be a whole number, not ''");
}

}  // namespace
}  // namespace footwall::tasks
