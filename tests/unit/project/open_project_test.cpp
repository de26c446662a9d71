#include <gtest/gtest.h>
#include <sys/wait.h>

#include <fmt/format.h>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "storage/base/partial_file.h"
#include "unit/project/project_folder.h"

namespace footwall::project {
namespace {

class OpenProject : public ProjectFolder {
 protected:
  int recorded_events() const {
    sqlite3* db = nullptr;
    EXPECT_EQ(sqlite3_open_v2(path_.c_str(), &db, SQLITE_OPEN_READONLY, nullptr), SQLITE_OK);
    int count = 0;
    const auto add = [](void* to, int, char** values, char**) {
      *static_cast<int*>(to) = std::atoi(values[0]);
      return 0;
    };
    EXPECT_EQ(sqlite3_exec(db, "SELECT count(*) FROM event", add, &count, nullptr), SQLITE_OK);
    sqlite3_close(db);
    return count;
  }
};

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

// A process of our own kind that runs `body` and then ends with what it returns; go() lets it pass wait().
class OtherProcess {
 public:
  template <class Body>
  explicit OtherProcess(const Body& body) {
    if (::pipe(told_) != 0 || ::pipe(asked_) != 0) throw std::runtime_error("no pipe");
    process_ = ::fork();
    if (process_ == 0) ::_exit(body(*this));
  }
  ~OtherProcess() {
    if (process_ > 0) kill();
    for (const int end : {told_[0], told_[1], asked_[0], asked_[1]}) ::close(end);
  }
  OtherProcess(const OtherProcess&) = delete;
  OtherProcess& operator=(const OtherProcess&) = delete;

  // In the other process: says that it is here, and waits for go().
  void wait_here() const {
    char byte = 'x';
    if (::write(told_[1], &byte, 1) != 1 || ::read(asked_[0], &byte, 1) != 1) ::_exit(99);
  }
  // In this one.
  void until_it_waits() const {
    char byte = 0;
    ASSERT_EQ(::read(told_[0], &byte, 1), 1);
  }
  void go() const { ASSERT_EQ(::write(asked_[1], "x", 1), 1); }
  void kill() {
    ::kill(process_, SIGKILL);
    ended();
  }
  int ended() {
    int status = 0;
    ::waitpid(process_, &status, 0);
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  int told_[2];
  int asked_[2];
  pid_t process_ = -1;
};

TEST_F(OpenProject, AWriterThatSleptThroughItsLeaseWritesNoMore) {
  Project::create(path_, {}).close();
  OtherProcess sleeper([&](const OtherProcess& self) {
    auto project = Project::open(path_, OpenMode::kWrite, with(FileSystem::kNetwork));
    project.edit("before", [](Interpretation& it) { it.add_fault("before"); });
    self.wait_here();
    for (int attempt = 0; attempt < 2; ++attempt) {
      try {
        project.edit("late", [](Interpretation& it) { it.add_fault("late"); });
        return 1;
      } catch (const Error& error) {
        if (error.code() != ErrorCode::kHeld) return 2;
      }
    }
    if (!project.read_only()) return 3;
    project.close();
    return 0;
  });
  sleeper.until_it_waits();
  EXPECT_EQ(error_of([&] { Project::open(path_, OpenMode::kWrite, with(FileSystem::kNetwork)); }).code(),
            ErrorCode::kHeld);
  std::filesystem::last_write_time(path_.string() + ".lock",
                                   std::filesystem::file_time_type::clock::now() - std::chrono::seconds(61));
  auto project = Project::open(path_, OpenMode::kWrite, with(FileSystem::kNetwork));
  ASSERT_EQ(project.notices().size(), 2U);
  EXPECT_NE(project.notices()[1].find("took over"), std::string::npos);
  sleeper.go();
  EXPECT_EQ(sleeper.ended(), 0);
  project.edit("after", [](Interpretation& it) { it.add_fault("after"); });
  ASSERT_EQ(project.faults().size(), 2U);
  EXPECT_EQ(project.faults()[1].name, "after");
  project.close();
  EXPECT_EQ(recorded_events(), 1) << "the take-over stands in the project";
  EXPECT_EQ(files_in(folder_.path()), 1U);
}

TEST_F(OpenProject, ALeaseLostInTheMiddleOfAnEditKeepsTheEditOut) {
  Project::create(path_, {}).close();
  auto project = Project::open(path_, OpenMode::kWrite, with(FileSystem::kNetwork));
  const Error error = error_of([&] {
    project.edit("add", [&](Interpretation& it) {
      it.add_fault("F");
      write_whole_file(path_.string() + ".lock", R"({"host":"other","pid":1,"token":"t","since":"now"})");
    });
  });
  EXPECT_EQ(error.code(), ErrorCode::kHeld);
  EXPECT_TRUE(project.faults().empty());
  EXPECT_TRUE(project.read_only());
}

TEST_F(OpenProject, AWriterKilledInTheMiddleOfAnEditLeavesTheStateBefore) {
  for (const FileSystem kind : {FileSystem::kNetwork, FileSystem::kLocal}) {
    const auto path = folder_ / (kind == FileSystem::kNetwork ? "n.footwall" : "l.footwall");
    Project::create(path, {}).close();
    OtherProcess writer([&](const OtherProcess& self) {
      auto project = Project::open(path, OpenMode::kWrite, with(kind));
      project.edit("kept", [](Interpretation& it) { it.add_fault("kept"); });
      project.edit("lost", [&](Interpretation& it) {
        for (int n = 0; n < 200; ++n) it.add_fault(fmt::format("lost {}", n));
        self.wait_here();
      });
      return 1;
    });
    writer.until_it_waits();
    writer.kill();
    auto project = Project::open(path, OpenMode::kWrite, with(kind));
    ASSERT_EQ(project.faults().size(), 1U);
    EXPECT_TRUE(project.check().ok());
    project.close();
    EXPECT_FALSE(std::filesystem::exists(path.string() + "-journal"));
    EXPECT_FALSE(std::filesystem::exists(path.string() + "-wal"));
  }
}

TEST_F(OpenProject, AReaderIsToldWhoWrites) {
  auto writer = Project::create(path_, {});
  auto reader = Project::open(path_, OpenMode::kRead);
  ASSERT_EQ(reader.notices().size(), 1U);
  EXPECT_NE(reader.notices()[0].find(fmt::format("process {}", ::getpid())), std::string::npos);
  writer.close();
  EXPECT_TRUE(Project::open(path_, OpenMode::kRead).notices().empty());
}

TEST_F(OpenProject, ALogOfAnotherMachineIsNotReadThroughTheNetwork) {
  auto writer = Project::create(path_, {});
  EXPECT_NO_THROW(Project::open(path_, OpenMode::kRead, with(FileSystem::kNetwork))) << "same machine";
  const auto lock = path_.string() + ".lock";
  std::filesystem::remove(lock);  // the writer finds out later
  write_whole_file(lock, R"({"host":"server","pid":1,"token":"t","since":"now","machine":"m"})");
  const Error error = error_of([&] { Project::open(path_, OpenMode::kRead, with(FileSystem::kNetwork)); });
  EXPECT_EQ(error.code(), ErrorCode::kHeld);
  EXPECT_NE(error.message().find("'server'"), std::string::npos);
}

TEST_F(OpenProject, WhoMayNotWriteReadsWhatIsBeingWritten) {
  if (::geteuid() != 0) GTEST_SKIP() << "skipped: only root can become another user";
  std::filesystem::permissions(folder_.path(), std::filesystem::perms{0755});
  auto writer = Project::create(path_, {});
  const auto faults_seen = [&](const OtherProcess&) {
    if (::setgid(65534) != 0 || ::setuid(65534) != 0) return 90;
    try {
      return static_cast<int>(Project::open(path_, OpenMode::kRead).faults().size());
    } catch (const Error& error) {
      std::fprintf(stderr, "%s\n", error.what());
      return 91;
    }
  };
  writer.edit("add", [](Interpretation& it) { it.add_fault("F"); });
  EXPECT_EQ(OtherProcess(faults_seen).ended(), 1) << "still in the log";
  auto reader = Project::open(path_, OpenMode::kRead);
  reader.faults();
  writer.close();
  reader.close();
  EXPECT_EQ(OtherProcess(faults_seen).ended(), 1);
  tamper("PRAGMA journal_mode = WAL");
  EXPECT_EQ(OtherProcess(faults_seen).ended(), 1) << "closed, but still marked as written through a log";
}

// A file that grows between two looks at it is not cut short.
TEST_F(OpenProject, ReadersComeAtAnyMomentOfAWriterThatComesAndGoes) {
  Project::create(path_, {}).close();
  OtherProcess writer([this](const OtherProcess&) {
    for (int round = 0; round < 40; ++round) {
      auto project = Project::open(path_, OpenMode::kWrite);
      project.edit("grow", [round](Interpretation& it) {
        const auto fault = it.add_fault(fmt::format("F{}", round));
        it.set_fault_property(fault, "note", std::string(60000, 'n'));
      });
    }
    return 0;
  });
  int looks = 0;
  std::size_t seen = 0;
  for (; seen < 40 && looks < 100000; ++looks) {
    const auto now = Project::open(path_, OpenMode::kRead).faults().size();
    ASSERT_GE(now, seen);
    seen = now;
  }
  EXPECT_EQ(writer.ended(), 0);
  EXPECT_EQ(seen, 40U);
}

TEST_F(OpenProject, ACopyIsOneMomentOfAProjectThatIsBeingWritten) {
  auto writer = Project::create(path_, small_survey());
  writer.edit("add", [](Interpretation& it) { it.add_fault("F"); });
  const auto reader = Project::open(path_, OpenMode::kRead);
  const auto copy = folder_ / "copy.footwall";
  bool written = false;
  const JobContext job([&](const Progress&) {
    if (!std::exchange(written, true)) writer.edit("add", [](Interpretation& it) { it.add_fault("G"); });
  });
  reader.copy_database(copy, job);
  ASSERT_TRUE(written);
  EXPECT_EQ(read_whole_file(copy, 1 << 26)[18], '\1') << "needs no log beside it";
  EXPECT_EQ(Project::open(copy, OpenMode::kRead).faults().size(), 1U);
  EXPECT_EQ(writer.faults().size(), 2U);
  EXPECT_EQ(error_of([&] { reader.copy_database(copy, {}); }).code(), ErrorCode::kInvalid);
  const auto before = files_in(folder_.path());
  const JobContext cancelled;
  cancelled.cancel();
  EXPECT_EQ(error_of([&] { reader.copy_database(folder_ / "none.footwall", cancelled); }).code(),
            ErrorCode::kCancelled);
  EXPECT_EQ(files_in(folder_.path()), before);
}

TEST_F(OpenProject, ANewerProjectIsRefusedWithBothVersions) {
  Project::create(path_, {}).close();
  tamper("PRAGMA user_version = 7");
  for (const OpenMode mode : {OpenMode::kRead, OpenMode::kWrite}) {
    const Error error = error_of([&] { Project::open(path_, mode); });
    EXPECT_EQ(error.code(), ErrorCode::kUnsupported);
    EXPECT_NE(error.message().find("version 7"), std::string::npos);
    EXPECT_NE(error.message().find("up to 4"), std::string::npos);
  }
}

const std::vector<Migration> kSteps{
    {5, "faults know their throw", "ALTER TABLE fault ADD COLUMN throw REAL NOT NULL DEFAULT 0", false},
    {6, "wells", "CREATE TABLE well(id INTEGER PRIMARY KEY NOT NULL, name TEXT NOT NULL) STRICT", false}};

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
    EXPECT_EQ(project.schema_version(), 6);
    ASSERT_EQ(project.notices().size(), 1U);
    EXPECT_NE(project.notices()[0].find("backup-v4"), std::string::npos);
    EXPECT_EQ(project.redo(), "add F2") << "steps of the older schema fit tables with columns appended";
    EXPECT_EQ(project.faults().size(), 2U);
    EXPECT_EQ(project.undo(), "add F2");
    EXPECT_EQ(project.undo(), "add F1");
    EXPECT_TRUE(project.faults().empty());
  }
  const auto old = Project::open(path_.string() + ".backup-v4", OpenMode::kRead);
  EXPECT_EQ(old.schema_version(), 4);
  EXPECT_EQ(old.faults().size(), 1U);
  EXPECT_EQ(Project::open(path_, OpenMode::kRead, with(kSteps)).schema_version(), 6);
  EXPECT_EQ(error_of([&] { Project::open(path_, OpenMode::kWrite); }).code(), ErrorCode::kUnsupported);
}

TEST_F(OpenProject, AProjectOfVersionOneGetsSurfacesThatBelongToFaults) {
  const survey::Surface surface{"S", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  {
    auto project = Project::create(path_, {});
    project.edit("import", [&](Interpretation& it) { it.add_surface(surface, "test"); });
    project.edit("remove", [&](Interpretation& it) { it.delete_surface(1); });
    project.edit("import", [&](Interpretation& it) { it.add_surface(surface, "test"); });
  }
  // As version 1 had it, also in the log: a changeset of a table with fewer columns.
  tamper(
      "ALTER TABLE surface DROP COLUMN vertical_unit; ALTER TABLE surface DROP COLUMN horizontal_unit;"
      "ALTER TABLE surface DROP COLUMN fault; DROP TABLE face_voxels; DROP TABLE view; DELETE FROM edit; "
      "PRAGMA user_version "
      "= 1");
  {
    const auto project = Project::open(path_, OpenMode::kRead);
    EXPECT_EQ(project.schema_version(), 1);
    ASSERT_EQ(project.surfaces().size(), 1U);
    EXPECT_EQ(project.surfaces()[0].units, (SurfaceUnits{"m", "m"}));
    EXPECT_EQ(project.surface(project.surfaces()[0].id).triangles, surface.triangles);
    EXPECT_FALSE(project.surface_of(1));
    EXPECT_FALSE(std::filesystem::exists(path_.string() + ".backup-v1"));
  }
  {
    auto project = Project::open(path_, OpenMode::kWrite);
    EXPECT_EQ(project.schema_version(), 4);
    ASSERT_EQ(project.notices().size(), 1U);
    EXPECT_NE(project.notices()[0].find("from schema version 1 to 4"), std::string::npos);
    project.edit("import again", [&](Interpretation& it) {
      it.add_surface({"T", surface.vertices, surface.triangles}, "test", it.add_fault("F"), {"ft", "s"});
    });
    EXPECT_EQ(project.surfaces().at(1).units, (SurfaceUnits{"ft", "s"}));
  }
  EXPECT_TRUE(std::filesystem::exists(path_.string() + ".backup-v1"));
}

TEST_F(OpenProject, AMigrationThatChangesMoreEndsTheHistory) {
  {
    auto project = Project::create(path_, {});
    project.edit("add F1", [](Interpretation& it) { it.add_fault("F1"); });
  }
  auto steps = kSteps;
  steps[0] = {5, "surfaces by name", "CREATE INDEX surface_by_name ON surface(name)", true};
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
  EXPECT_EQ(project.schema_version(), 4);
  EXPECT_EQ(project.survey(), small_survey());
}

}  // namespace
}  // namespace footwall::project
