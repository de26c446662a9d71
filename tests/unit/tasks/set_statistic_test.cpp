#include "engine/tasks/set_statistic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <sstream>

#include "engine/tasks/face_tables.h"
#include "scratch_folder.h"
#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

class SetStatisticTest : public ::testing::Test {
 protected:
  SetStatisticTest() {
    survey::Geometry g;
    g.inlines = {100, 1, 50};
    g.crosslines = {300, 1, 50};
    g.samples = 100;
    g.interval = 4;
    g.map = {1000, 2000, 10, 0, 0, 10};
    project_.emplace(project::Project::create(folder_ / "p.footwall", g));
    add_fault("A", 3);
  }
  void add_fault(const std::string& name, std::int64_t panel) {
    std::int64_t fault = 0;
    project_->edit("add", [&](project::Interpretation& picks) { fault = picks.add_fault(name); });
    project::MeshRecord mesh;
    mesh.revision = project_->fault(fault).revision;
    mesh.algorithm = "test";
    for (int n = 0; n < 4; ++n) {
      mesh.vertices.push_back({project::MeshVertex::Owner::kPanel,
                               panel,
                               n,
                               {1100.0 + 10 * n, 2100.0 + (n % 2) * 20, 40.0 + 4 * n}});
    }
    mesh.faces = {{panel, 0, {0, 1, 2}}, {panel, 1, {1, 2, 3}}};
    project_->store_mesh(fault, mesh);
  }
  StatisticSet set(const std::string& table, const SetStatistic& what = {"throw", "m", ""}) {
    std::istringstream in(table);
    return set_statistic(*project_, what, in);
  }
  Error refusal(const std::string& table, const SetStatistic& what = {"throw", "m", ""}) {
    const std::size_t before = project_->runs().size();
    try {
      set(table, what);
    } catch (const Error& error) {
      EXPECT_EQ(project_->runs().size(), before);
      return error;
    }
    return {ErrorCode::kInternal, "no error"};
  }

  ScratchFolder folder_;
  std::optional<project::Project> project_;
};

TEST_F(SetStatisticTest, IsARunThatTablesFindByItsStatistic) {
  const StatisticSet done = set("face,value\n3.1,2.5\n");
  EXPECT_EQ(done.faces, 1);
  EXPECT_EQ(done.undefined, 1);
  const auto run = chosen_run(*project_, {}, "throw");
  ASSERT_TRUE(run);
  EXPECT_EQ(run->id, done.run);
  EXPECT_EQ(run->name, "throw");
  const FaceTables faces = face_tables(*project_, "", run->id, Coordinates::kWorld);
  const auto& values = values_of(faces.tables.at(0), "throw");
  EXPECT_TRUE(std::isnan(values[0]));
  EXPECT_EQ(values[1], 2.5);
  EXPECT_TRUE(faces.stale.empty());
  // Without samples to count, all that have a value are ranked.
  EXPECT_EQ(ranked_faces(faces, "throw", true, 10).size(), 1u);
  EXPECT_EQ(chosen_run(*project_, {}, "variance"), std::nullopt);
}

TEST_F(SetStatisticTest, AComputedRunStaysTheDefault) {
  project::RunRecord computed;
  computed.volume = "amplitude";
  const std::int64_t id = project_->add_run(computed, {});
  const StatisticSet done = set("face,value\n3.1,2.5\n");
  EXPECT_EQ(chosen_run(*project_, {})->id, id);
  EXPECT_EQ(chosen_run(*project_, {}, "variance")->id, id);
  EXPECT_EQ(chosen_run(*project_, {}, "throw")->id, done.run);
  EXPECT_EQ(chosen_run(*project_, done.run, "variance")->id, done.run);
}

TEST_F(SetStatisticTest, ReplacesTheFormerRunOfItsNameAlone) {
  const StatisticSet first = set("face,value\n3.0,1\n");
  const StatisticSet other = set("face,value\n3.0,2\n", {"throw", "m", "another"});
  EXPECT_FALSE(other.replaced);
  const StatisticSet second = set("face,value\n3.0,3\n");
  EXPECT_TRUE(second.replaced);
  ASSERT_EQ(project_->runs().size(), 2u);
  EXPECT_THROW(project_->run(first.run), Error);
  EXPECT_EQ(project_->run(other.run).name, "another");
}

TEST_F(SetStatisticTest, RefusesFacesByNameAndNumber) {
  const Error absent = refusal("face,value\n3.0,1\n3.7,1\n4.1,2\n");
  EXPECT_EQ(absent.code(), ErrorCode::kInvalid);
  EXPECT_NE(absent.message().find("2 of the faces are not there: 3.7 (line 3), 4.1 (line 4)"),
            std::string::npos)
      << absent.message();
  EXPECT_NE(refusal("face,value\n3.0,1\n3.0,2\n").message().find("twice"), std::string::npos);
  EXPECT_NE(refusal("fault,face,value\nB,3.0,1\n").message().find("B 3.0"), std::string::npos);
}

TEST_F(SetStatisticTest, AsksForTheFaultWhereTwoHaveTheFace) {
  add_fault("B", 3);
  EXPECT_NE(refusal("face,value\n3.0,1\n").message().find("A and B both have"), std::string::npos);
  EXPECT_EQ(set("fault,face,value\nA,3.0,1\nB,3.0,2\n").faces, 2);
}

TEST_F(SetStatisticTest, RefusesNamesAndUnitsThatAreTaken) {
  for (const char* name : {"variance", "fault", "x0", ""})
    EXPECT_EQ(refusal("face,value\n3.0,1\n", {name, "1", ""}).code(), ErrorCode::kInvalid) << name;
  set("face,value\n3.0,1\n", {"throw", "m", "one"});
  EXPECT_NE(refusal("face,value\n3.0,1\n", {"throw", "ms", "two"}).message().find("in m, not in ms"),
            std::string::npos);
  EXPECT_EQ(set("face,value\n3.0,1\n", {"throw", "ms", "one"}).faces, 1);  // it replaces the only one in m
}

TEST_F(SetStatisticTest, SurvivesOtherParameters) {
  project::RunRecord strange;
  strange.parameters = R"({"set_statistic": 5})";
  EXPECT_EQ(statistic_set_by_hand(strange), "");
  strange.parameters = "not JSON";
  EXPECT_EQ(statistic_set_by_hand(strange), "");
}

}  // namespace
}  // namespace footwall::tasks
