#include "engine/tasks/edit_script.h"

#include <gtest/gtest.h>

#include <optional>
#include <sstream>

#include "scratch_folder.h"
#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

using nlohmann::json;

class EditScript : public ::testing::Test {
 protected:
  void SetUp() override {
    survey::Geometry g;
    g.inlines = {100, 2, 40};
    g.crosslines = {300, 1, 50};
    g.samples = 60;
    g.interval = 4;
    g.map = {1000, 2000, 10, 0, 0, 20};
    project_.emplace(project::Project::create(folder_ / "p.footwall", g));
  }
  json apply(const std::string& line) { return apply_edit_line(*project_, line, 1); }

  ScratchFolder folder_;
  std::optional<project::Project> project_;
};

TEST_F(EditScript, BuildsAFaultLineByLineAndEachLineIsOneStep) {
  std::istringstream script(R"(
# a fault from scratch
{"op":"add","what":"fault","name":"F1"}
{"op":"add","what":"pillar","fault":"F1","nodes":[{"x":1,"y":2,"z":3},{"inline":104,"crossline":301.5,"z":40},[7,8,9]]}
{"op":"add","what":"node","pillar":1,"at":2,"x":5,"y":5,"z":5}
{"op":"move","what":"node","node":1,"position":[1.5,2,3]}
{"op":"rename","what":"fault","fault":1,"name":"Main"}
{"op":"set","what":"fault","fault":"Main","property":"tie_tolerance","value":3.5}
)");
  std::vector<json> replies;
  EXPECT_EQ(apply_edit_script(*project_, script, [&](const json& reply) { replies.push_back(reply); }), 6);
  EXPECT_EQ(replies[0], json::parse(R"({"fault":1,"step":1})"));
  EXPECT_EQ(replies[1], json::parse(R"({"pillar":1,"nodes":[1,2,3],"step":2})"));
  EXPECT_EQ(replies[2], json::parse(R"({"node":4,"step":3})"));
  EXPECT_EQ(project_->fault("Main").tie_tolerance, 3.5);
  const auto nodes = project_->pillars(1).at(0).nodes;
  ASSERT_EQ(nodes.size(), 4U);
  EXPECT_EQ(nodes[0].position, (survey::WorldPoint{1.5, 2, 3}));
  EXPECT_EQ(nodes[1].position, (survey::WorldPoint{1020, 2030, 40}));
  EXPECT_EQ(nodes[2].id, 4);
  EXPECT_EQ(project_->history().size(), 6U);
  EXPECT_EQ(project_->history()[3].name, "move node 1");
  EXPECT_EQ(project_->history()[0].name, "add fault 'F1'");
}

TEST_F(EditScript, ShortFormsMeanTheSame) {
  apply(R"({"op":"add_fault","name":"F1"})");
  apply(R"({"op":"add pillar","fault":1,"nodes":[[0,0,0],[0,0,9]]})");
  EXPECT_EQ(apply(R"({"op":"add_node","pillar":1,"x":0,"y":0,"z":12})")["node"], 3);
  EXPECT_EQ(project_->pillars(1).at(0).nodes.back().position.z, 12);
  apply(R"({"op":"move_pillar","id":1,"dz":1})");
  EXPECT_EQ(project_->pillars(1).at(0).nodes.back().position.z, 13);
  apply(R"({"op":"move fault","fault":"F1","dx":2})");
  EXPECT_EQ(project_->pillars(1).at(0).nodes.back().position, (survey::WorldPoint{2, 0, 13}));
  apply(R"({"op":"delete_node","node":2})");
  apply(R"({"op":"delete_fault","name":"F1"})");
  EXPECT_TRUE(project_->faults().empty());
}

TEST_F(EditScript, ABadLineIsNamedAndNothingOfItIsApplied) {
  apply(R"({"op":"add","what":"fault","name":"F1"})");
  for (const char* bad : {
           "",
           "[]",
           "7",
           "{",
           R"({"op":"add"})",
           R"({"op":"add","what":"horizon","name":"x"})",
           R"({"op":"fold","what":"fault","fault":"F1"})",
           R"({"op":"add","what":"fault","name":"F1"})",
           R"({"op":"add","what":"fault","name":7})",
           R"({"op":"add","what":"fault","name":"F2","color":"#ffffff"})",
           R"({"op":"add","what":"pillar","fault":"F9","nodes":[[0,0,0]]})",
           R"({"op":"add","what":"pillar","fault":"F1","nodes":[[0,0]]})",
           R"({"op":"add","what":"pillar","fault":"F1","nodes":[]})",
           R"({"op":"add","what":"pillar","fault":"F1","nodes":[{"x":1,"y":2,"z":"3"}]})",
           R"({"op":"add","what":"pillar","fault":"F1","nodes":[{"x":1,"y":2,"z":3,"w":4}]})",
           R"({"op":"move","what":"node","node":5,"x":1,"y":2,"z":3})",
           R"({"op":"delete","what":"pillar","pillar":1.5})",
           R"({"op":"add_fault","what":"node","name":"F3"})",
           R"({"op":"add","what":"fault","name":"a\u0000b"})",
           R"({"op":"set","what":"fault","fault":1,"property":"x"})",
       }) {
    try {
      apply_edit_line(*project_, bad, 42);
      ADD_FAILURE() << "accepted: " << bad;
    } catch (const Error& error) {
      EXPECT_TRUE(error.message().starts_with("line 42: ")) << error.message();
    }
    EXPECT_EQ(project_->history().size(), 1U) << bad;
  }
}

TEST_F(EditScript, StopsAtTheFirstBadLineAndKeepsThoseBefore) {
  std::istringstream script(
      "{\"op\":\"add_fault\",\"name\":\"A\"}\n\nnonsense\n{\"op\":\"add_fault\",\"name\":\"B\"}\n");
  try {
    apply_edit_script(*project_, script, [](const json&) {});
    ADD_FAILURE() << "nonsense was accepted";
  } catch (const Error& error) {
    EXPECT_TRUE(error.message().starts_with("line 3: ")) << error.message();
  }
  EXPECT_EQ(project_->faults().size(), 1U);
}

}  // namespace
}  // namespace footwall::tasks
