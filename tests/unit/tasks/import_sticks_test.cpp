#include "engine/tasks/import_sticks.h"

#include <gtest/gtest.h>

#include <optional>
#include <set>

#include "engine/tasks/export_sticks.h"
#include "scratch_folder.h"
#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

survey::Geometry small_survey() {
  survey::Geometry g;
  g.inlines = {100, 2, 50};
  g.crosslines = {300, 1, 60};
  g.samples = 100;
  g.interval = 4;
  g.map = {1000, 2000, 20, 0, 0, 25};
  return g;
}

class SticksOfAProject : public ::testing::Test {
 protected:
  project::Project make(const std::string& name, bool surveyed) const {
    return project::Project::create(folder_ / name, surveyed ? std::optional(small_survey()) : std::nullopt);
  }
  std::filesystem::path sticks(const std::string& content) const {
    return folder_.file("sticks.txt", content);
  }

  ScratchFolder folder_;
};

TEST_F(SticksOfAProject, EachFaultHasAColourOfItsOwn) {
  project::Project project = make("p.footwall", true);
  const std::string rows =
      "INLINE- 100 300 1000 2000 100 A 1\nINLINE- 100 301 1000 2025 120 A 1\n"
      "INLINE- 100 310 1000 2250 100 B 1\nINLINE- 100 311 1000 2275 120 B 1\n";
  import_sticks(project, sticks(rows), "charisma", {}, {});
  import_sticks(project, sticks(rows), "charisma", {}, {});
  std::set<std::string> colours;
  for (const project::FaultRecord& fault : project.faults()) colours.insert(fault.colour);
  EXPECT_EQ(project.faults().size(), 4U);
  EXPECT_EQ(colours.size(), 4U);
}

TEST_F(SticksOfAProject, ComeInAsOneUndoableEditInTheSurveysUnit) {
  project::Project project = make("p.footwall", true);
  formats::SticksOptions options;
  options.z_unit = "s";
  options.z_positive_up = true;
  const SticksImported done =
      import_sticks(project,
                    sticks("INLINE- 104 310 1040 2250 -0.1 F 1\nINLINE- 104 310 1040 2250 -0.2 F 1\n"
                           "INLINE- 104 312 1040 2300 -0.2 G 1\n"),
                    "", options);
  EXPECT_EQ(done.format, "charisma");
  EXPECT_EQ(done.faults, (std::vector<std::string>{"F", "G"}));
  EXPECT_EQ(done.pillars, 2);
  EXPECT_TRUE(done.notices.empty());
  const auto nodes = project.pillars(project.fault("F").id).at(0).nodes;
  ASSERT_EQ(nodes.size(), 2U);
  EXPECT_DOUBLE_EQ(nodes[1].position.z, 200);
  EXPECT_EQ(project.history().size(), 1U);
  project.undo();
  EXPECT_TRUE(project.faults().empty());
}

TEST_F(SticksOfAProject, ACancelLeavesTheProjectAsItWas) {
  project::Project project = make("p.footwall", true);
  const auto file = sticks("INLINE- 104 310 1040 2250 100 F 1\nINLINE- 104 310 1040 2250 200 F 1\n");
  JobContext* told = nullptr;
  // Cancelled once the file has been read.
  JobContext job([&](const Progress& progress) {
    if (progress.phase == "read") told->cancel();
  });
  told = &job;
  try {
    import_sticks(project, file, "", {}, job);
    FAIL() << "not cancelled";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kCancelled);
  }
  EXPECT_TRUE(project.faults().empty());
  EXPECT_TRUE(project.history().empty());
}

TEST_F(SticksOfAProject, NamesThatAreTakenOrTooLongDoNotRefuseTheFile) {
  project::Project project = make("p.footwall", true);
  const std::string longest(200, 'a');
  const auto file = sticks("INLINE- 104 310 1040 2250 8 " + longest + "b 1\nINLINE- 104 310 1040 2250 8 " +
                           longest + "c 1\nINLINE- 104 310 1040 2250 8 F 1\n");
  import_sticks(project, file, "", {});
  const SticksImported again = import_sticks(project, file, "", {});
  ASSERT_EQ(again.faults.size(), 3U);
  for (const std::string& name : again.faults) EXPECT_LE(name.size(), 200U);
  EXPECT_EQ(again.faults[2], "F (2)");
  EXPECT_EQ(project.faults().size(), 6U);
  EXPECT_EQ(again.report.renamed.back(), "F -> F (2)");
}

TEST_F(SticksOfAProject, FileNamesThatNoStepCouldCarryAreCut) {
  project::Project project = make("p.footwall", true);
  const auto file = folder_.file(std::string(240, 'n') + "\xE4.dat", "1040 2250 8 1\n");
  EXPECT_EQ(import_sticks(project, file, "", {}).faults.at(0), std::string(200, 'n'));
  EXPECT_EQ(project.history().at(0).name, "Import " + std::string(193, 'n'));
}

TEST_F(SticksOfAProject, LineNumbersNeedASurvey) {
  formats::SticksOptions options;
  options.columns.emplace();
  options.columns->inline_number = 1;
  options.columns->crossline_number = 2;
  options.columns->z = 3;
  options.columns->stick = 4;
  const auto file = sticks("104 310 8 1\n104 311 12 1\n");
  project::Project surveyed = make("p.footwall", true);
  import_sticks(surveyed, file, "", options);
  EXPECT_EQ(surveyed.pillars(1).at(0).nodes.at(1).position, (survey::WorldPoint{1040, 2275, 12}));
  project::Project empty = make("e.footwall", false);
  try {
    import_sticks(empty, file, "", options);
    ADD_FAILURE() << "was imported";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInvalid);
    EXPECT_NE(error.hint().find("import volume"), std::string::npos);
  }
}

TEST_F(SticksOfAProject, APreviewShowsTwentyRowsAndChangesNothing) {
  project::Project project = make("p.footwall", true);
  std::string rows;
  for (int n = 0; n < 30; ++n) rows += "1040 2250 " + std::to_string(n) + " " + std::to_string(n / 3) + "\n";
  const SticksPreview preview = preview_sticks(project, sticks(rows + "1 2\n9e9 9e9 8 99\n"), "", {});
  ASSERT_EQ(preview.rows.size(), 20U);
  EXPECT_EQ(preview.rows[19].stick, 6);
  EXPECT_EQ(preview.rows[19].fault, "sticks");
  EXPECT_EQ(preview.counts.pillars, 11);
  EXPECT_EQ(preview.counts.report.rejected_count, 1);
  ASSERT_EQ(preview.counts.notices.size(), 1U);
  EXPECT_NE(preview.counts.notices[0].find("1 of 31 points lie outside"), std::string::npos);
  EXPECT_TRUE(project.faults().empty());
  EXPECT_TRUE(project.history().empty());
}

TEST_F(SticksOfAProject, GoOutPickedAloneUnlessAskedFor) {
  project::Project project = make("p.footwall", true);
  project.edit("pick", [](project::Interpretation& picks) {
    const std::int64_t fault = picks.add_fault("F 1");
    const std::vector<survey::WorldPoint> nodes{{1049, 2262.4, 8}, {1051, 2262.6, 9.5}};
    const auto a = picks.add_pillar(fault, survey::PillarKind::kInterpreted, nodes);
    const auto b = picks.add_pillar(fault, survey::PillarKind::kInterpreted, nodes);
    survey::Pillar between;
    between.kind = survey::PillarKind::kInterpolated;
    between.nodes = a.nodes;
    between.parent_a = a.id;
    between.parent_b = b.id;
    between.parameter = 0.5;
    picks.add_pillar(fault, between);
    picks.snap_pillar(b.id, nodes);
  });
  SticksChoice choice;
  const SticksExported picked = export_sticks(project, folder_ / "o.txt", "charisma", choice);
  EXPECT_EQ(picked.pillars, 2);
  EXPECT_EQ(picked.nodes, 4);
  EXPECT_TRUE(picked.renamed.empty());
  const std::string text = content_of(folder_ / "o.txt");
  // The nearest lines: inline 100 + 2 x 2.45 -> 104, and 2.55 -> 106; crossline 310.496 -> 310, 310.504 ->
  // 311.
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "INLINE-     104     310        1049.0000        2262.4000       8.0000 F 1 1");
  EXPECT_NE(text.find("INLINE-     106     311 "), std::string::npos);
  EXPECT_NE(text.find("F 1 2\n"), std::string::npos);
  choice.interpolated = true;
  choice.names_without_blanks = true;
  const SticksExported all = export_sticks(project, folder_ / "o.txt", "charisma", choice);
  EXPECT_EQ(all.pillars, 3);
  EXPECT_EQ(all.renamed, (std::vector<std::string>{"F 1 -> F_1"}));
  choice.fault = "G";
  EXPECT_THROW(export_sticks(project, folder_ / "o.txt", "charisma", choice), Error);
}

TEST_F(SticksOfAProject, UnitsAreConvertedWithinTheDomainOfTheSurvey) {
  project::Project project = make("p.footwall", true);
  import_sticks(project, sticks("INLINE- 104 310 1040 2250 1234.5678 F 1\n"), "", {});
  SticksChoice choice;
  choice.z_unit = "s";
  choice.z_positive_up = true;
  export_sticks(project, folder_ / "o.txt", "charisma", choice);
  EXPECT_NE(content_of(folder_ / "o.txt").find(" -1.2345678 F 1"), std::string::npos);
  choice.z_unit = "ft";
  EXPECT_THROW(export_sticks(project, folder_ / "o.txt", "charisma", choice), Error);
  const project::Project empty = make("e.footwall", false);
  EXPECT_THROW(project_sticks(empty, choice), Error);
  choice.z_unit.clear();
  EXPECT_EQ(project_sticks(empty, choice).how.vertical_unit, "");
  EXPECT_THROW(export_sticks(empty, folder_ / "e.txt", "charisma", choice), Error);
}

}  // namespace
}  // namespace footwall::tasks
