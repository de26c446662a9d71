#include "storage/project/interpretation.h"

#include <gtest/gtest.h>

#include <limits>

#include "unit/project/project_folder.h"

namespace footwall::project {
namespace {

using survey::Pillar;
using survey::PillarKind;
using survey::WorldPoint;

class InterpretationTest : public ProjectFolder {
 protected:
  void SetUp() override {
    ProjectFolder::SetUp();
    project_.emplace(Project::create(path_, {}));
    project_->edit("start", [&](Interpretation& it) {
      fault_ = it.add_fault("F1");
      a_ = it.add_pillar(fault_, PillarKind::kInterpreted, std::vector<WorldPoint>{{0, 0, 0}, {0, 0, 10}});
      b_ = it.add_pillar(fault_, PillarKind::kInterpreted, std::vector<WorldPoint>{{8, 0, 0}, {8, 4, 10}});
      Pillar between;
      between.kind = PillarKind::kInterpolated;
      between.nodes = {{0, {2, 0, 0}}, {0, {2, 0.5, 5}}, {0, {2, 1, 10}}};
      between.parent_a = a_.id;
      between.parent_b = b_.id;
      between.parameter = 0.25;
      child_ = it.add_pillar(fault_, between);
    });
  }
  void TearDown() override {
    project_.reset();
    ProjectFolder::TearDown();
  }
  Pillar stored(std::int64_t id) const {
    for (const Pillar& pillar : project_->pillars(fault_)) {
      if (pillar.id == id) return pillar;
    }
    ADD_FAILURE() << "no pillar " << id;
    return {};
  }
  std::optional<Project> project_;
  std::int64_t fault_ = 0;
  Pillar a_, b_, child_;
};

TEST_F(InterpretationTest, PillarsComeBackAsTheyWerePicked) {
  const auto pillars = project_->pillars(fault_);
  ASSERT_EQ(pillars.size(), 3U);
  EXPECT_EQ(pillars[1].nodes[1].position, (WorldPoint{8, 4, 10}));
  EXPECT_EQ(pillars[1].nodes[1].id, b_.nodes[1].id);
  EXPECT_EQ(pillars[2].kind, PillarKind::kInterpolated);
  EXPECT_EQ(pillars[2].parent_b, b_.id);
  EXPECT_EQ(pillars[2].parameter, 0.25);
  const WorldPoint picked{606000.1, 6074000.3, 1.0 / 3};
  project_->edit("move", [&](Interpretation& it) { it.move_node(a_.nodes[0].id, picked); });
  EXPECT_EQ(stored(a_.id).nodes[0].position, picked);
}

TEST_F(InterpretationTest, PillarsGoToAnotherFaultWithTheirChildren) {
  std::int64_t other = 0;
  project_->edit("split", [&](Interpretation& it) {
    other = it.add_fault("F2");
    it.assign_pillars(std::vector<std::int64_t>{a_.id, b_.id}, other);
  });
  EXPECT_TRUE(project_->pillars(fault_).empty());
  const auto moved = project_->pillars(other);
  ASSERT_EQ(moved.size(), 3U);
  EXPECT_EQ(moved[0].id, a_.id);
  EXPECT_EQ(moved[0].nodes[1].id, a_.nodes[1].id);
  EXPECT_EQ(moved[2].kind, PillarKind::kInterpolated);
  EXPECT_EQ(moved[2].parent_a, a_.id);
  project_->undo();
  EXPECT_EQ(project_->pillars(fault_).size(), 3U);
}

TEST_F(InterpretationTest, AChildStaysWithNeitherParentAlone) {
  std::int64_t other = 0;
  const auto result = project_->edit("split", [&](Interpretation& it) {
    other = it.add_fault("F2");
    it.assign_pillars(std::vector<std::int64_t>{a_.id}, other);
  });
  EXPECT_EQ(result.removed, std::vector<std::int64_t>{child_.id});
  EXPECT_EQ(project_->pillars(fault_).size(), 1U);
  project_->undo();
  project_->edit("split", [&](Interpretation& it) {
    other = it.add_fault("F2");
    it.assign_pillars(std::vector<std::int64_t>{child_.id}, other);
  });
  ASSERT_EQ(project_->pillars(other).size(), 1U);
  EXPECT_EQ(project_->pillars(other)[0].kind, PillarKind::kInterpreted);
  EXPECT_EQ(project_->pillars(other)[0].parent_a, 0);
}

TEST_F(InterpretationTest, AReversedPillarKeepsItsNodes) {
  project_->edit("reverse", [&](Interpretation& it) { it.reverse_pillar(a_.id); });
  EXPECT_EQ(stored(a_.id).nodes[0].id, a_.nodes[1].id);
  EXPECT_EQ(stored(a_.id).nodes[0].position, a_.nodes[1].position);
  EXPECT_EQ(stored(a_.id).nodes[1].id, a_.nodes[0].id);
}

TEST_F(InterpretationTest, NodesAreReorderedWithTheirIdsOrNotAtAll) {
  std::int64_t third = 0;
  project_->edit("insert", [&](Interpretation& it) { third = it.insert_node(a_.id, 2, {1, 1, 15}); });
  const std::int64_t first = a_.nodes[0].id, second = a_.nodes[1].id;
  const auto reorder = [&](std::vector<std::int64_t> order) {
    project_->edit("reorder", [&](Interpretation& it) { it.reorder_nodes(a_.id, order); });
  };
  reorder({third, first, second});
  const survey::Pillar now = stored(a_.id);
  ASSERT_EQ(now.nodes.size(), 3U);
  EXPECT_EQ(now.nodes[0].id, third);
  EXPECT_EQ(now.nodes[0].position, (WorldPoint{1, 1, 15}));
  EXPECT_EQ(now.nodes[1].id, first);
  EXPECT_EQ(now.nodes[2].position, a_.nodes[1].position);
  for (const auto& wrong : std::vector<std::vector<std::int64_t>>{
           {}, {first, second}, {first, second, second}, {first, second, third, third}, {first, second, 999}})
    EXPECT_EQ(error_of([&] { reorder(wrong); }).code(), ErrorCode::kInvalid);
  EXPECT_EQ(stored(a_.id).nodes[0].id, third);
  project_->undo();
  EXPECT_EQ(stored(a_.id).nodes[0].id, first);
}

TEST_F(InterpretationTest, NodesStandWhereTheyWereInserted) {
  std::int64_t front = 0, middle = 0, back = 0;
  project_->edit("insert", [&](Interpretation& it) {
    front = it.insert_node(a_.id, 0, {1, 1, -5});
    back = it.insert_node(a_.id, 3, {1, 1, 15});
    middle = it.insert_node(a_.id, 2, {1, 1, 5});
  });
  std::vector<std::int64_t> ids;
  for (const auto& node : stored(a_.id).nodes) ids.push_back(node.id);
  EXPECT_EQ(ids, (std::vector<std::int64_t>{front, a_.nodes[0].id, middle, a_.nodes[1].id, back}));
  project_->edit("delete", [&](Interpretation& it) {
    it.delete_node(middle);
    it.delete_node(front);
    it.insert_node(a_.id, 1, {9, 9, 9});
  });
  EXPECT_EQ(stored(a_.id).nodes[1].position, (WorldPoint{9, 9, 9}));
  EXPECT_EQ(stored(a_.id).nodes[3].id, back);
}

TEST_F(InterpretationTest, AnInterpolatedPillarFollowsItsParentsInTheSameEdit) {
  const auto result = project_->edit("move", [&](Interpretation& it) { it.move_pillar(b_.id, {0, 40, 0}); });
  EXPECT_EQ(result.regenerated, (std::vector<std::int64_t>{child_.id}));
  const Pillar moved = stored(child_.id);
  EXPECT_EQ(moved.kind, PillarKind::kInterpolated);
  ASSERT_EQ(moved.nodes.size(), 3U);
  EXPECT_NEAR(moved.nodes[0].position.y, 10, 1e-12);
  EXPECT_NEAR(moved.nodes[2].position.y, 11, 1e-12);
  EXPECT_EQ(moved.nodes[1].id, child_.nodes[1].id);
  project_->undo();
  EXPECT_EQ(stored(child_.id).nodes[0].position, child_.nodes[0].position);
}

TEST_F(InterpretationTest, TheRegeneratorDecidesWhereTheyGo) {
  project_->set_regenerator(
      [&](const FaultRecord& fault, std::span<const Pillar> pillars, std::span<const Pillar> children) {
        EXPECT_EQ(fault.id, fault_);
        EXPECT_EQ(pillars.size(), 3U);
        EXPECT_EQ(pillars[0].nodes[0].position.x, 5) << "it must see the parents where they are now";
        EXPECT_EQ(children.size(), 1U);
        return std::vector<std::vector<WorldPoint>>{{{7, 7, 7}}};
      });
  project_->edit("move", [&](Interpretation& it) { it.move_node(a_.nodes[0].id, {5, 0, 0}); });
  ASSERT_EQ(stored(child_.id).nodes.size(), 1U);
  EXPECT_EQ(stored(child_.id).nodes[0].position, (WorldPoint{7, 7, 7}));
  project_->set_regenerator([](const FaultRecord&, std::span<const Pillar>,
                               std::span<const Pillar>) -> std::vector<std::vector<WorldPoint>> {
    throw Error(ErrorCode::kInvalid, "cannot be interpolated");
  });
  EXPECT_THROW(project_->edit("move",
                              [&](Interpretation& it) {
                                it.move_node(a_.nodes[0].id, {6, 0, 0});
                              }),
               Error);
  EXPECT_EQ(stored(a_.id).nodes[0].position.x, 5) << "the move goes with what it could not bring about";
}

TEST_F(InterpretationTest, AHandOnAnInterpolatedPillarMakesItInterpreted) {
  project_->edit("move", [&](Interpretation& it) { it.move_node(child_.nodes[1].id, {2, 2, 2}); });
  EXPECT_EQ(stored(child_.id).kind, PillarKind::kInterpreted);
  EXPECT_EQ(stored(child_.id).parent_a, 0);
  const auto result = project_->edit("move", [&](Interpretation& it) { it.move_pillar(a_.id, {1, 1, 1}); });
  EXPECT_TRUE(result.regenerated.empty());
  project_->undo();
  project_->undo();
  EXPECT_EQ(stored(child_.id).kind, PillarKind::kInterpolated);
  project_->edit("accept", [&](Interpretation& it) { it.accept_pillar(child_.id); });
  EXPECT_EQ(stored(child_.id).kind, PillarKind::kInterpreted);
}

TEST_F(InterpretationTest, AParentTakesItsInterpolatedChildrenAlong) {
  const auto result = project_->edit("delete", [&](Interpretation& it) { it.delete_pillar(a_.id); });
  EXPECT_EQ(result.removed, (std::vector<std::int64_t>{child_.id}));
  EXPECT_EQ(project_->pillars(fault_).size(), 1U);
  project_->undo();
  EXPECT_EQ(project_->pillars(fault_).size(), 3U);
  EXPECT_EQ(stored(child_.id).parent_a, a_.id);
}

TEST_F(InterpretationTest, ASnappedPillarKeepsItsFormerPositions) {
  project_->edit("snap", [&](Interpretation& it) {
    it.snap_pillar(a_.id, std::vector<WorldPoint>{{1, 0, 0}, {1, 0, 10}});
    it.snap_pillar(a_.id, std::vector<WorldPoint>{{2, 0, 0}, {2, 0, 10}});
  });
  EXPECT_EQ(stored(a_.id).kind, PillarKind::kSnapped);
  project_->edit("look", [&](Interpretation& it) {
    EXPECT_EQ(it.former_positions(a_.id), (std::vector<WorldPoint>{{0, 0, 0}, {0, 0, 10}}));
    EXPECT_TRUE(it.former_positions(b_.id).empty());
  });
}

TEST_F(InterpretationTest, RefusesWhatNobodyCouldUse) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string before = interpretation();
  const auto code = [&](const std::function<void(Interpretation&)>& change) {
    return error_of([&] { project_->edit("bad", change); }).code();
  };
  const auto none = std::vector<WorldPoint>{};
  EXPECT_EQ(code([&](Interpretation& it) { it.add_fault("F1"); }), ErrorCode::kInvalid);
  EXPECT_EQ(code([&](Interpretation& it) { it.add_fault(""); }), ErrorCode::kInvalid);
  EXPECT_EQ(code([&](Interpretation& it) { it.add_fault("a\nb"); }), ErrorCode::kInvalid);
  EXPECT_EQ(code([&](Interpretation& it) { it.add_fault("\xff\xfe"); }), ErrorCode::kInvalid);
  EXPECT_EQ(code([&](Interpretation& it) { it.add_pillar(fault_, PillarKind::kInterpreted, none); }),
            ErrorCode::kInvalid);
  EXPECT_EQ(code([&](Interpretation& it) {
              it.move_node(a_.nodes[0].id, {nan, 0, 0});
            }),
            ErrorCode::kInvalid);
  EXPECT_EQ(code([&](Interpretation& it) { it.move_node(999, {0, 0, 0}); }), ErrorCode::kNotFound);
  EXPECT_EQ(code([&](Interpretation& it) { it.insert_node(a_.id, 3, {0, 0, 0}); }), ErrorCode::kInvalid);
  EXPECT_EQ(code([&](Interpretation& it) { it.delete_pillar(999); }), ErrorCode::kNotFound);
  EXPECT_EQ(code([&](Interpretation& it) { it.set_fault_property(fault_, "colour", "red"); }),
            ErrorCode::kInvalid);
  EXPECT_EQ(code([&](Interpretation& it) { it.set_fault_property(fault_, "size", "1"); }),
            ErrorCode::kInvalid);
  EXPECT_EQ(code([&](Interpretation& it) {
              it.delete_node(a_.nodes[0].id);
              it.delete_node(a_.nodes[1].id);
            }),
            ErrorCode::kInvalid);
  EXPECT_EQ(code([&](Interpretation& it) {
              Pillar grandchild = child_;
              grandchild.parent_b = child_.id;
              it.add_pillar(fault_, grandchild);
            }),
            ErrorCode::kInvalid);
  EXPECT_EQ(interpretation(), before);
}

TEST_F(InterpretationTest, ALockedFaultStaysAsItIs) {
  project_->edit("lock", [&](Interpretation& it) { it.set_fault_property(fault_, "locked", "true"); });
  EXPECT_TRUE(project_->fault("F1").locked);
  const Error error = error_of([&] {
    project_->edit("move", [&](Interpretation& it) { it.move_node(a_.nodes[0].id, {1, 1, 1}); });
  });
  EXPECT_NE(error.message().find("locked"), std::string::npos);
  EXPECT_THROW(project_->edit("delete", [&](Interpretation& it) { it.delete_fault(fault_); }), Error);
  project_->edit("unlock", [&](Interpretation& it) { it.set_fault_property(fault_, "locked", "false"); });
  EXPECT_TRUE(project_->edit("move",
                             [&](Interpretation& it) {
                               it.move_node(a_.nodes[0].id, {1, 1, 1});
                             })
                  .changed);
}

TEST_F(InterpretationTest, SurfacesAreKeptWholeAndUndone) {
  survey::Surface surface;
  surface.name = "imported";
  for (int n = 0; n < 1000; ++n) surface.vertices.push_back({n / 3.0, n * n / 7.0, -n * 0.1});
  for (int n = 0; n + 2 < 1000; ++n) surface.triangles.push_back({n, n + 1, n + 2});
  std::int64_t id = 0;
  project_->edit("import", [&](Interpretation& it) { id = it.add_surface(surface, "gocad_tsurf"); });
  const auto back = project_->surface(id);
  EXPECT_EQ(back.vertices, surface.vertices);
  EXPECT_EQ(back.triangles, surface.triangles);
  EXPECT_EQ(project_->surfaces().at(0).kind, "gocad_tsurf");
  project_->undo();
  EXPECT_TRUE(project_->surfaces().empty());
  project_->redo();
  EXPECT_EQ(project_->surface(id).vertices, surface.vertices);
  surface.name = "bad";
  surface.triangles[5][1] = 1000;
  EXPECT_THROW(project_->edit("import", [&](Interpretation& it) { it.add_surface(surface, "x"); }), Error);
}

TEST_F(InterpretationTest, ASurfaceIsTheShapeOfItsFaultAndGoesWithIt) {
  const survey::Surface surface{"S", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  std::int64_t fault = 0;
  project_->edit("import", [&](Interpretation& it) {
    fault = it.add_fault("imported");
    it.add_surface(surface, "test", fault, {"m", "ms"});
  });
  const auto found = project_->surface_of(fault);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->fault, fault);
  EXPECT_EQ(found->triangles, 1);
  EXPECT_EQ(found->units, (SurfaceUnits{"m", "ms"}));
  const std::int64_t revision = project_->fault(fault).revision;
  EXPECT_GT(revision, 0);
  // It takes no pillars and no second surface; a fault of pillars takes no surface.
  const std::vector<survey::WorldPoint> nodes{{0, 0, 0}, {0, 0, 5}};
  const survey::Surface other{"T", surface.vertices, surface.triangles};
  EXPECT_THROW(
      project_->edit(
          "x", [&](Interpretation& it) { it.add_pillar(fault, survey::PillarKind::kInterpreted, nodes); }),
      Error);
  EXPECT_THROW(project_->edit("x", [&](Interpretation& it) { it.add_surface(other, "test", fault); }), Error);
  EXPECT_THROW(project_->edit("x", [&](Interpretation& it) { it.add_surface(other, "test", fault_); }),
               Error);
  // Both go and come back together.
  project_->edit("delete", [&](Interpretation& it) { it.delete_fault(fault); });
  EXPECT_TRUE(project_->surfaces().empty());
  EXPECT_FALSE(project_->surface_of(fault));
  project_->undo();
  EXPECT_EQ(project_->fault(fault).revision, revision);
  EXPECT_EQ(project_->surface(project_->surface_of(fault)->id).triangles, surface.triangles);
  project_->undo();
  EXPECT_TRUE(project_->surfaces().empty());
  // Pillars of other faults are no surface's.
  EXPECT_FALSE(project_->surface_of(fault_));
  EXPECT_FALSE(project_->surface_of(0));
}

}  // namespace
}  // namespace footwall::project
