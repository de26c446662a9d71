#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <fmt/format.h>
#include <csignal>
#include <random>
#include <set>
#include <stdexcept>

#include "rounds.h"
#include "unit/project/project_folder.h"

namespace footwall::project {
namespace {

using Edit = ProjectFolder;
using survey::PillarKind;
using survey::WorldPoint;

// One random change, of any kind; may be refused.
void random_change(Interpretation& it, std::mt19937& random) {
  const auto pick = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  const auto point = [&] { return WorldPoint{random() / 7.0, random() / -3.0, random() / 11.0}; };
  const auto faults = it.faults();
  if (faults.empty() || random() % 10 == 0) {
    it.add_fault(fmt::format("F{}", random()));
    return;
  }
  const FaultRecord fault = faults[pick(faults.size())];
  const auto pillars = it.pillars(fault.id);
  const std::size_t what = pillars.empty() ? 0 : pick(12);
  if (what <= 2) {
    const std::vector<WorldPoint> nodes(1 + pick(5), point());
    it.add_pillar(fault.id, PillarKind::kInterpreted, nodes);
    return;
  }
  const survey::Pillar pillar = pillars[pick(pillars.size())];
  const auto node = pillar.nodes[pick(pillar.nodes.size())].id;
  switch (what) {
    case 3:
      it.delete_pillar(pillar.id);
      break;
    case 4:
      it.move_node(node, point());
      break;
    case 5:
      it.insert_node(pillar.id, static_cast<std::int64_t>(pick(pillar.nodes.size() + 1)), point());
      break;
    case 6:
      if (pillar.nodes.size() > 1) it.delete_node(node);
      break;
    case 7:
      it.move_pillar(pillar.id, {1, -2, 0.1});
      break;
    case 8:
      it.set_fault_property(fault.id, "note", fmt::format("note {}", random()));
      break;
    case 9:
      it.snap_pillar(pillar.id, std::vector<WorldPoint>{point(), point()});
      break;
    case 10:
      it.set_chart(fault.id, Bytes(pick(100), std::byte{7}));
      break;
    default:
      if (random() % 4 == 0) {
        it.delete_fault(fault.id);
      } else {
        it.rename_fault(fault.id, fmt::format("R{}", random()));
      }
  }
}

TEST_F(Edit, UndoingAllIsTheStartAndRedoingAllIsTheEnd) {
  auto project = Project::create(path_, small_survey());
  const std::string start = interpretation();
  std::mt19937 random(4711);
  std::vector<std::string> states;
  for (int step = 0; step < rounds(60); ++step) {
    const auto result = project.edit(fmt::format("step {}", step), [&](Interpretation& it) {
      for (int n = 0; n < 3; ++n) random_change(it, random);
    });
    if (result.changed) states.push_back(interpretation());
  }
  ASSERT_GT(states.size(), 50U);
  for (std::size_t s = states.size(); s-- > 0;) {
    ASSERT_EQ(interpretation(), states[s]);
    ASSERT_TRUE(project.undo());
  }
  EXPECT_FALSE(project.undo());
  EXPECT_EQ(interpretation(), start);

  // The log outlives closing, in the middle of it.
  project.close();
  project = Project::open(path_, OpenMode::kWrite);
  EXPECT_EQ(project.history().size(), states.size());
  EXPECT_TRUE(project.history().front().undone);
  for (const std::string& state : states) {
    ASSERT_TRUE(project.redo());
    ASSERT_EQ(interpretation(), state);
  }
  EXPECT_FALSE(project.redo());
  EXPECT_TRUE(project.check().ok());
}

TEST_F(Edit, ANewEditDropsWhatCouldBeRedoneAndNamesAreKept) {
  auto project = Project::create(path_, {});
  project.edit("add F1", [](Interpretation& it) { it.add_fault("F1"); });
  project.edit("add F2", [](Interpretation& it) { it.add_fault("F2"); });
  EXPECT_EQ(project.undo(), "add F2");
  project.edit("add F3", [](Interpretation& it) { it.add_fault("F3"); });
  EXPECT_FALSE(project.redo());
  const auto history = project.history();
  ASSERT_EQ(history.size(), 2U);
  EXPECT_EQ(history[1].name, "add F3");
  EXPECT_FALSE(history[1].undone);
}

TEST_F(Edit, WhatChangesNothingIsNotRecordedAndKeepsRedo) {
  auto project = Project::create(path_, {});
  project.edit("add F1", [](Interpretation& it) { it.add_fault("F1"); });
  project.edit("add F2", [](Interpretation& it) { it.add_fault("F2"); });
  project.undo();
  const std::string before = interpretation();
  EXPECT_FALSE(project.edit("nothing", [](Interpretation&) {}).changed);
  EXPECT_FALSE(project.edit("there and back", [](Interpretation& it) { it.delete_fault(it.add_fault("F9")); })
                   .changed);
  EXPECT_FALSE(
      project.edit("same note", [](Interpretation& it) { it.set_fault_property(1, "note", ""); }).changed);
  EXPECT_EQ(interpretation(), before);
  EXPECT_EQ(project.redo(), "add F2");
}

TEST_F(Edit, AnExceptionRollsEverythingBackAndPassesThrough) {
  auto project = Project::create(path_, {});
  const std::string before = interpretation();
  EXPECT_THROW(project.edit("fails",
                            [](Interpretation& it) {
                              it.add_fault("F1");
                              throw std::runtime_error("the caller's own");
                            }),
               std::runtime_error);
  EXPECT_EQ(interpretation(), before);
  EXPECT_TRUE(project.history().empty());
  EXPECT_TRUE(project.edit("works again", [](Interpretation& it) { it.add_fault("F1"); }).changed);
}

TEST_F(Edit, IdsAreNeverUsedTwice) {
  auto project = Project::create(path_, {});
  std::set<std::int64_t> faults, nodes;
  const std::vector<WorldPoint> line{{1, 2, 3}, {4, 5, 6}};
  for (int round = 0; round < 4; ++round) {
    project.edit("add", [&](Interpretation& it) {
      const auto fault = it.add_fault("F");
      EXPECT_TRUE(faults.insert(fault).second) << "fault id " << fault << " came back";
      for (const auto& node : it.add_pillar(fault, PillarKind::kInterpreted, line).nodes) {
        EXPECT_TRUE(nodes.insert(node.id).second) << "node id " << node.id << " came back";
      }
    });
    if (round == 1) {
      project.edit("delete", [&](Interpretation& it) { it.delete_fault(it.fault_id("F")); });
    } else {
      project.undo();
    }
    project.close();
    project = Project::open(path_, OpenMode::kWrite);
  }
}

TEST_F(Edit, IsNotEnteredTwiceAndEndsWithItsInterpretation) {
  auto project = Project::create(path_, {});
  EXPECT_EQ(error_of([&] {
              project.edit("outer", [&](Interpretation&) { project.edit("inner", [](Interpretation&) {}); });
            }).code(),
            ErrorCode::kInternal);
  EXPECT_EQ(error_of([&] { project.edit("outer", [&](Interpretation&) { project.undo(); }); }).code(),
            ErrorCode::kInternal);
  EXPECT_EQ(error_of([&] { project.edit("", [](Interpretation&) {}); }).code(), ErrorCode::kInvalid);
}

// In one transaction there and back: the same as step by step, and nothing where it is cancelled on the way.
TEST_F(Edit, GoesToAnyStep) {
  auto project = Project::create(path_, small_survey());
  for (int n = 0; n < 30; ++n) {
    const std::string name = fmt::format("F{}", n);
    project.edit(fmt::format("add {}", name), [&](Interpretation& it) { it.add_fault(name); });
  }
  const auto history = project.history();
  EXPECT_EQ(project.go_to_step(history[9].id, JobContext()), 20);
  EXPECT_EQ(project.faults().size(), 10U);
  EXPECT_EQ(project.go_to_step(history[9].id, JobContext()), 0);
  EXPECT_EQ(project.go_to_step(history[24].id, JobContext()), 15);
  EXPECT_EQ(project.faults().size(), 25U);
  EXPECT_EQ(project.undo(), "add F24");

  int reports = 0;
  std::function<void()> cancel;
  const JobContext job([&](const Progress&) {
    if (++reports == 5) cancel();
  });
  cancel = [&] { job.cancel(); };
  EXPECT_EQ(error_of([&] { project.go_to_step(0, job); }).code(), ErrorCode::kCancelled);
  EXPECT_EQ(project.faults().size(), 24U);
  EXPECT_EQ(project.go_to_step(0, JobContext()), 24);
  EXPECT_TRUE(project.faults().empty());
  EXPECT_EQ(project.go_to_step(history.back().id, JobContext()), 30);
  EXPECT_EQ(project.faults().size(), 30U);
}

TEST_F(Edit, UndoMakesAMeshFreshAgain) {
  auto project = Project::create(path_, {});
  std::int64_t fault = 0, node = 0;
  project.edit("add", [&](Interpretation& it) {
    fault = it.add_fault("F");
    node = it.add_pillar(fault, PillarKind::kInterpreted, std::vector<WorldPoint>{{1, 2, 3}}).nodes[0].id;
  });
  EXPECT_TRUE(project.mesh_is_stale(fault));
  MeshRecord mesh;
  mesh.revision = project.fault(fault).revision;
  project.store_mesh(fault, mesh);
  EXPECT_FALSE(project.mesh_is_stale(fault));
  project.edit("colour", [&](Interpretation& it) { it.set_fault_property(fault, "colour", "#00ff00"); });
  EXPECT_FALSE(project.mesh_is_stale(fault)) << "a colour is no shape";
  project.edit("move", [&](Interpretation& it) { it.move_node(node, {1, 2, 4}); });
  EXPECT_TRUE(project.mesh_is_stale(fault));
  project.undo();
  EXPECT_FALSE(project.mesh_is_stale(fault));
  project.edit("move elsewhere", [&](Interpretation& it) { it.move_node(node, {1, 2, 5}); });
  EXPECT_TRUE(project.mesh_is_stale(fault)) << "another shape must not get the revision of the undone one";
}

TEST_F(Edit, AStepThatDoesNotFitIsRefusedAndNothingChanges) {
  {
    auto project = Project::create(path_, {});
    project.edit("add", [](Interpretation& it) { it.add_fault("F"); });
    project.edit("note", [](Interpretation& it) { it.set_fault_property(1, "note", "a"); });
  }
  tamper("UPDATE fault SET note = 'somebody else'");
  auto project = Project::open(path_, OpenMode::kWrite);
  const std::string before = interpretation();
  const Error error = error_of([&] { project.undo(); });
  EXPECT_EQ(error.code(), ErrorCode::kCorrupt);
  EXPECT_NE(error.message().find("'note'"), std::string::npos);
  EXPECT_EQ(interpretation(), before);
  EXPECT_FALSE(project.history().back().undone);
}

// A child edits and tells each edit that returned; killed at some point, it must have kept them all.
TEST_F(Edit, AKilledProcessLosesNothingThatWasCommitted) {
  Project::create(path_, {}).close();
  for (int round = 0; round < 3; ++round) {
    int pipe_ends[2];
    ASSERT_EQ(::pipe(pipe_ends), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      auto project = Project::open(path_, OpenMode::kWrite);
      for (int n = 0;; ++n) {
        const std::string name = fmt::format("F{}-{:06}", round, n);
        project.edit("add " + name, [&](Interpretation& it) { it.add_fault(name); });
        if (::write(pipe_ends[1], "x", 1) != 1) ::_exit(1);
      }
    }
    ::close(pipe_ends[1]);
    const int wanted = 10 + 7 * round;
    int committed = 0;
    char byte = 0;
    while (committed < wanted && ::read(pipe_ends[0], &byte, 1) == 1) ++committed;
    ::kill(child, SIGKILL);
    while (::read(pipe_ends[0], &byte, 1) == 1) ++committed;
    ::close(pipe_ends[0]);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
    ASSERT_GE(committed, wanted);
    auto project = Project::open(path_, OpenMode::kWrite);
    EXPECT_TRUE(project.check().ok());
    int kept = 0;
    for (const auto& fault : project.faults())
      kept += fault.name.starts_with(fmt::format("F{}-", round)) ? 1 : 0;
    EXPECT_GE(kept, committed);
    EXPECT_LE(kept, committed + 1);
    EXPECT_EQ(project.faults().size(), project.history().size());
  }
}

TEST_F(Edit, AFullDiskKeepsWhatWasThere) {
  auto project = Project::create(path_, {});
  project.edit("add F1", [](Interpretation& it) { it.add_fault("F1"); });
  project.close();
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    auto mine = Project::open(path_, OpenMode::kWrite);
    const rlimit limit{std::filesystem::file_size(path_) + 100000, RLIM_INFINITY};
    if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) ::_exit(2);
    std::mt19937 random(1);
    Bytes chart(4 << 20);
    for (std::byte& b : chart) b = static_cast<std::byte>(random());
    try {
      mine.edit("chart", [&](Interpretation& it) { it.set_chart(1, chart); });
      ::_exit(3);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::kIo || error.hint().empty()) ::_exit(4);
    }
    const bool usable =
        mine.edit("small", [](Interpretation& it) { it.set_fault_property(1, "note", "n"); }).changed;
    mine.close();
    ::_exit(usable ? 0 : 5);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  const auto after = Project::open(path_, OpenMode::kRead);
  EXPECT_TRUE(after.fault("F1").chart.empty());
  EXPECT_EQ(after.fault("F1").note, "n");
  EXPECT_TRUE(after.check().ok());
}

TEST_F(Edit, TrimmingDropsOldStepsAloneAndLeavesWhatTheyDid) {
  auto project = Project::create(path_, small_survey());
  for (const char* name : {"A", "B", "C", "D"})
    project.edit(name, [&](Interpretation& it) { it.add_fault(name); });
  project.undo();
  tamper("UPDATE edit SET made = '2020-01-01T00:00:00Z' WHERE name IN ('A', 'B', 'D')");
  EXPECT_EQ(project.history_size().steps, 4);
  EXPECT_EQ(project.history_size("2021-01-01T00:00:00Z").steps, 2);  // D could be redone
  const HistorySize dropped = project.trim_history("2021-01-01T00:00:00Z");
  EXPECT_EQ(dropped.steps, 2);
  EXPECT_GT(dropped.bytes, 0);
  EXPECT_EQ(project.faults().size(), 3U);
  ASSERT_EQ(project.history().size(), 2U);
  EXPECT_EQ(project.redo(), "D");
  EXPECT_EQ(project.undo(), "D");
  EXPECT_EQ(project.undo(), "C");
  EXPECT_FALSE(project.undo());
  EXPECT_EQ(project.faults().size(), 2U);
  EXPECT_TRUE(project.check().ok());
  EXPECT_EQ(project.trim_history("2021-01-01T00:00:00Z").steps, 0);
}

TEST_F(Edit, TrimmingGivesTheRoomBack) {
  auto project = Project::create(path_, small_survey());
  std::vector<survey::WorldPoint> nodes;
  for (int n = 0; n < 2000; ++n) nodes.push_back({1.0 * n, 2.0 * n, 3.0 * n});
  std::int64_t fault = 0;
  project.edit("fault", [&](Interpretation& it) { fault = it.add_fault("F"); });
  for (int n = 0; n < 20; ++n) {
    std::int64_t pillar = 0;
    project.edit("add", [&](Interpretation& it) {
      pillar = it.add_pillar(fault, survey::PillarKind::kInterpreted, nodes).id;
    });
    project.edit("delete", [&](Interpretation& it) { it.delete_pillar(pillar); });
  }
  project.close();
  const auto before = std::filesystem::file_size(path_);
  project = Project::open(path_, OpenMode::kWrite);
  EXPECT_EQ(project.trim_history("9999-01-01T00:00:00Z").steps, 41);
  project.close();
  EXPECT_LT(std::filesystem::file_size(path_), before / 4);
}

}  // namespace
}  // namespace footwall::project
