#include <gtest/gtest.h>
#include <sys/wait.h>

#include <fmt/format.h>
#include <csignal>
#include <fstream>

#include "storage/base/partial_file.h"
#include "unit/project/project_folder.h"

namespace footwall::project {
namespace {

using OpenProject = ProjectFolder;

OpenOptions with(FileSystem kind) {
  OpenOptions options;
  options.file_system = kind;
  return options;
}

OpenOptions with(std::vector<Migration> migrations) {
  OpenOptions options;
  options.migrations = std::move(migrations);
  return options;
}

std::size_t files_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST_F(OpenProject, ACleanCloseLeavesOneFile) {
  auto project = Project::create(path_, small_survey());
  project.edit("add", [](Interpretation& it) { it.add_fault("F"); });
  EXPECT_GT(files_in(folder_.path()), 1U) << "a local project is written through a log, under a lock";
  project.close();
  EXPECT_EQ(files_in(folder_.path()), 1U);
  EXPECT_EQ(error_of([&] { project.edit("late", [](Interpretation&) {}); }).code(), ErrorCode::kInvalid);
}

TEST_F(OpenProject, ASecondWriterIsRefusedAndToldWhoHoldsIt) {
  auto first = Project::create(path_, {});
  const Error error = error_of([&] { Project::open(path_, OpenMode::kWrite); });
  EXPECT_EQ(error.code(), ErrorCode::kHeld);
  EXPECT_NE(error.message().find(fmt::format("process {}", ::getpid())), std::string::npos)
      << error.message();
  std::filesystem::create_symlink(path_, folder_ / "alias");
  EXPECT_EQ(error_of([&] { Project::open(folder_ / "alias", OpenMode::kWrite); }).code(), ErrorCode::kHeld);
  first.close();
  EXPECT_NO_THROW(Project::open(path_, OpenMode::kWrite));
}

TEST_F(OpenProject, TheLockOfAKilledWriterIsFree) {
  Project::create(path_, {}).close();
  int pipe_ends[2];
  ASSERT_EQ(::pipe(pipe_ends), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    auto project = Project::open(path_, OpenMode::kWrite);
    project.edit("add", [](Interpretation& it) { it.add_fault("F"); });
    if (::write(pipe_ends[1], "x", 1) != 1) ::_exit(1);
    for (;;) ::pause();
  }
  char byte = 0;
  ASSERT_EQ(::read(pipe_ends[0], &byte, 1), 1);
  EXPECT_EQ(error_of([&] { Project::open(path_, OpenMode::kWrite); }).code(), ErrorCode::kHeld);
  ::kill(child, SIGKILL);
  ASSERT_EQ(::waitpid(child, nullptr, 0), child);
  auto project = Project::open(path_, OpenMode::kWrite);
  EXPECT_EQ(project.faults().size(), 1U);
  ::close(pipe_ends[0]);
  ::close(pipe_ends[1]);
}

TEST_F(OpenProject, AReaderSeesWhatTheWriterCommitsAndCannotWrite) {
  auto writer = Project::create(path_, {});
  auto reader = Project::open(path_, OpenMode::kRead);
  EXPECT_TRUE(reader.read_only());
  writer.edit("add", [&](Interpretation& it) {
    it.add_fault("F");
    EXPECT_TRUE(reader.faults().empty()) << "not before the commit";
  });
  EXPECT_EQ(reader.faults().size(), 1U);
  EXPECT_EQ(error_of([&] { reader.edit("x", [](Interpretation&) {}); }).code(), ErrorCode::kInvalid);
  EXPECT_EQ(error_of([&] { reader.undo(); }).code(), ErrorCode::kInvalid);
  writer.close();
  EXPECT_EQ(reader.faults().size(), 1U) << "a writer that leaves must not take the reader's file away";
  reader.close();
  EXPECT_EQ(Project::open(path_, OpenMode::kWrite).faults().size(), 1U);
}

TEST_F(OpenProject, ReadOnlyMediaAreNeverWritten) {
  auto writer = Project::create(path_, small_survey());
  writer.edit("add", [](Interpretation& it) { it.add_fault("F"); });
  writer.close();
  const auto before = read_whole_file(path_, 1 << 24);
  {
    auto project = Project::open(path_, OpenMode::kRead, with(FileSystem::kReadOnly));
    EXPECT_EQ(project.faults().size(), 1U);
    EXPECT_EQ(files_in(folder_.path()), 1U);
  }
  EXPECT_EQ(error_of([&] { Project::open(path_, OpenMode::kWrite, with(FileSystem::kReadOnly)); }).code(),
            ErrorCode::kIo);
  EXPECT_EQ(read_whole_file(path_, 1 << 24), before);
  std::ofstream(path_.string() + "-wal") << "not folded in";
  EXPECT_NE(error_of([&] { Project::open(path_, OpenMode::kRead, with(FileSystem::kReadOnly)); })
                .message()
                .find("not closed cleanly"),
            std::string::npos);
}

TEST_F(OpenProject, ANetworkFileSystemIsSaidAndNeedsNoSharedMemory) {
  Project::create(path_, {}).close();
  auto project = Project::open(path_, OpenMode::kWrite, with(FileSystem::kNetwork));
  ASSERT_EQ(project.notices().size(), 1U);
  EXPECT_NE(project.notices()[0].find("network"), std::string::npos);
  project.edit("add", [](Interpretation& it) { it.add_fault("F"); });
  EXPECT_FALSE(std::filesystem::exists(path_.string() + "-wal"));
  EXPECT_EQ(error_of([&] { Project::open(path_, OpenMode::kWrite, with(FileSystem::kNetwork)); }).code(),
            ErrorCode::kHeld);
  // Somebody took the lease over: this one must stop, before its next edit.
  write_whole_file(path_.string() + ".lock", R"({"host":"other","pid":1,"token":"t","since":"now"})");
  const Error error = error_of([&] { project.edit("add", [](Interpretation& it) { it.add_fault("G"); }); });
  EXPECT_EQ(error.code(), ErrorCode::kHeld);
  EXPECT_NE(error.message().find("'other'"), std::string::npos);
  EXPECT_TRUE(project.read_only());
  EXPECT_EQ(project.faults().size(), 1U);
}

TEST_F(OpenProject, ANewerProjectIsRefusedWithBothVersions) {
  Project::create(path_, {}).close();
  tamper("PRAGMA user_version = 7");
  for (const OpenMode mode : {OpenMode::kRead, OpenMode::kWrite}) {
    const Error error = error_of([&] { Project::open(path_, mode); });
    EXPECT_EQ(error.code(), ErrorCode::kUnsupported);
    EXPECT_NE(error.message().find("version 7"), std::string::npos);
    EXPECT_NE(error.message().find("up to 2"), std::string::npos);
  }
}

const std::vector<Migration> kSteps{
    {3, "faults know their throw", "ALTER TABLE fault ADD COLUMN throw REAL NOT NULL DEFAULT 0", false},
    {4, "wells", "CREATE TABLE well(id INTEGER PRIMARY KEY NOT NULL, name TEXT NOT NULL) STRICT", false}};

TEST_F(OpenProject, MigrationsRunForwardAfterABackupAndKeepUndo) {
  {
    auto project = Project::create(path_, small_survey());
    project.edit("add F1", [](Interpretation& it) { it.add_fault("F1"); });
    project.edit("add F2", [](Interpretation& it) { it.add_fault("F2"); });
    project.undo();
  }
  EXPECT_EQ(error_of([&] { Project::open(path_, OpenMode::kRead, with(kSteps)); }).code(),
            ErrorCode::kUnsupported);
  {
    auto project = Project::open(path_, OpenMode::kWrite, with(kSteps));
    EXPECT_EQ(project.schema_version(), 4);
    ASSERT_EQ(project.notices().size(), 1U);
    EXPECT_NE(project.notices()[0].find("backup-v2"), std::string::npos);
    EXPECT_EQ(project.redo(), "add F2") << "steps of the older schema fit tables with columns appended";
    EXPECT_EQ(project.faults().size(), 2U);
    EXPECT_EQ(project.undo(), "add F2");
    EXPECT_EQ(project.undo(), "add F1");
    EXPECT_TRUE(project.faults().empty());
  }
  const auto old = Project::open(path_.string() + ".backup-v2", OpenMode::kRead);
  EXPECT_EQ(old.schema_version(), 2);
  EXPECT_EQ(old.faults().size(), 1U);
  EXPECT_EQ(Project::open(path_, OpenMode::kRead, with(kSteps)).schema_version(), 4);
  EXPECT_EQ(error_of([&] { Project::open(path_, OpenMode::kWrite); }).code(), ErrorCode::kUnsupported);
}

TEST_F(OpenProject, AProjectOfVersionOneGetsSurfacesThatBelongToFaults) {
  const survey::Surface surface{"S", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  {
    auto project = Project::create(path_, {});
    project.edit("import", [&](Interpretation& it) { it.add_surface(surface, "test"); });
    project.edit("remove", [&](Interpretation& it) { it.delete_surface(1); });
  }
  // As version 1 had it, also in the log: a changeset of a table with fewer columns.
  tamper(
      "ALTER TABLE surface DROP COLUMN vertical_unit; ALTER TABLE surface DROP COLUMN horizontal_unit;"
      "ALTER TABLE surface DROP COLUMN fault; DELETE FROM edit; PRAGMA user_version = 1");
  {
    auto project = Project::open(path_, OpenMode::kWrite);
    EXPECT_EQ(project.schema_version(), 2);
    ASSERT_EQ(project.notices().size(), 1U);
    EXPECT_NE(project.notices()[0].find("from schema version 1 to 2"), std::string::npos);
    project.edit("import again", [&](Interpretation& it) {
      it.add_surface(surface, "test", it.add_fault("F"), {"ft", "s"});
    });
    EXPECT_EQ(project.surfaces().at(0).units, (SurfaceUnits{"ft", "s"}));
  }
  EXPECT_TRUE(std::filesystem::exists(path_.string() + ".backup-v1"));
}

TEST_F(OpenProject, AMigrationThatChangesMoreEndsTheHistory) {
  {
    auto project = Project::create(path_, {});
    project.edit("add F1", [](Interpretation& it) { it.add_fault("F1"); });
  }
  auto steps = kSteps;
  steps[0] = {3, "surfaces by name", "CREATE INDEX surface_by_name ON surface(name)", true};
  auto project = Project::open(path_, OpenMode::kWrite, with(steps));
  EXPECT_FALSE(project.undo());
  ASSERT_EQ(project.history().size(), 2U);
  EXPECT_TRUE(project.history()[1].barrier);
  EXPECT_NE(project.history()[1].name.find("history ends here"), std::string::npos);
  project.edit("add F2", [](Interpretation& it) { it.add_fault("F2"); });
  EXPECT_EQ(project.undo(), "add F2");
  EXPECT_FALSE(project.undo());
}

TEST_F(OpenProject, AMigrationThatFailsLeavesTheProjectAsItWas) {
  Project::create(path_, small_survey()).close();
  auto steps = kSteps;
  steps[1].sql = "DROP TABLE nowhere";
  EXPECT_THROW(Project::open(path_, OpenMode::kWrite, with(steps)), Error);
  auto project = Project::open(path_, OpenMode::kWrite);
  EXPECT_EQ(project.schema_version(), 2);
  EXPECT_EQ(project.survey(), small_survey());
}

}  // namespace
}  // namespace footwall::project
