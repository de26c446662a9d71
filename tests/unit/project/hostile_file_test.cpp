// Files that are no projects, were damaged, or were made to harm.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <fstream>
#include <random>

#include "rounds.h"
#include "storage/base/partial_file.h"
#include "unit/project/project_folder.h"

namespace footwall::project {
namespace {

class HostileFile : public ProjectFolder {
 protected:
  void make() {
    auto project = Project::create(path_, small_survey());
    project.edit("add", [](Interpretation& it) {
      const auto fault = it.add_fault("F");
      for (int n = 0; n < 200; ++n) {
        it.add_pillar(fault, survey::PillarKind::kInterpreted,
                      std::vector<survey::WorldPoint>(5, {1.0 * n, 2, 3}));
      }
      it.add_surface({"S", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, "test");
    });
    MeshRecord mesh;
    mesh.vertices = {{}, {}, {}};
    mesh.faces = {{1, 0, {0, 1, 2}}};
    project.store_mesh(1, mesh);
  }
  Error refused() const {
    const Error error = error_of([&] { Project::open(path_, OpenMode::kRead); });
    EXPECT_NE(error.message().find(path_.filename().string()), std::string::npos) << error.message();
    EXPECT_THROW(Project::open(path_, OpenMode::kWrite), Error);
    return error;
  }
};

TEST_F(HostileFile, WhatIsNoProjectIsCalledSo) {
  EXPECT_EQ(refused().code(), ErrorCode::kNotFound);
  std::ofstream(path_) << "";
  EXPECT_EQ(refused().code(), ErrorCode::kFormat);
  std::mt19937 random(3);
  std::string noise(100'000, ' ');
  for (char& c : noise) c = static_cast<char>(random());
  write_whole_file(path_, noise);
  EXPECT_EQ(refused().code(), ErrorCode::kFormat);
  std::filesystem::remove(path_);
  std::filesystem::create_directory(path_);
  EXPECT_EQ(refused().code(), ErrorCode::kFormat);
}

TEST_F(HostileFile, TheDatabaseOfAnotherProgramIsLeftAlone) {
  tamper("CREATE TABLE contact(id INTEGER PRIMARY KEY, name TEXT); PRAGMA application_id = 77");
  const Error error = refused();
  EXPECT_EQ(error.code(), ErrorCode::kFormat);
  EXPECT_NE(error.message().find("another program"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(path_.string() + ".lock"));
}

TEST_F(HostileFile, ATruncatedProjectIsCorrupt) {
  make();
  const auto size = std::filesystem::file_size(path_);
  std::filesystem::resize_file(path_, size - 4096);
  EXPECT_EQ(refused().code(), ErrorCode::kCorrupt);
  std::filesystem::resize_file(path_, 5000);
  EXPECT_EQ(refused().code(), ErrorCode::kCorrupt);
}

TEST_F(HostileFile, AnythingThatIsNotOurSchemaIsRefusedByName) {
  const std::pair<const char*, const char*> attacks[] = {
      {"CREATE TRIGGER evil AFTER INSERT ON fault BEGIN DELETE FROM pillar; END", "trigger evil"},
      {"CREATE VIEW evil AS SELECT * FROM fault", "view evil"},
      {"CREATE TABLE evil(x)", "table evil"},
      {"CREATE UNIQUE INDEX evil ON fault(name)", "index evil"},
      {"ALTER TABLE fault ADD COLUMN evil TEXT", "table fault"},
      {"DROP INDEX node_of_pillar", "index node_of_pillar"},
      {"DROP TABLE truth; CREATE TABLE truth(id INTEGER PRIMARY KEY, x AS (zeroblob(500000000)))",
       "table truth"},
      {"DROP TABLE setting; CREATE VIRTUAL TABLE setting USING fts5(name, value)", "setting"},
  };
  for (const auto& [sql, named] : attacks) {
    std::filesystem::remove(path_);
    make();
    tamper(sql);
    const Error error = refused();
    EXPECT_EQ(error.code(), ErrorCode::kFormat) << sql;
    EXPECT_NE(error.message().find(named), std::string::npos) << sql << ": " << error.message();
  }
}

TEST_F(HostileFile, BlobsThatAreNotWhatTheirCountsSayAreRefusedWhenRead) {
  make();
  tamper(
      "UPDATE mesh_vertex SET data = zeroblob(30000000);"
      "UPDATE mesh_face SET count = 9223372036854775807;"
      "UPDATE surface SET vertices = 400000000");
  auto project = Project::open(path_, OpenMode::kRead);
  EXPECT_EQ(error_of([&] { project.mesh(1); }).code(), ErrorCode::kCorrupt);
  EXPECT_EQ(error_of([&] { project.surface(1); }).code(), ErrorCode::kCorrupt);
  const auto report = project.check();
  EXPECT_EQ(report.problems.size(), 2U);
  for (const auto& problem : report.problems)
    EXPECT_NE(problem.find("expected"), std::string::npos) << problem;
}

TEST_F(HostileFile, RowsThatCannotBeMeantAreRefusedWhenRead) {
  make();
  tamper("UPDATE pillar SET kind = 9 WHERE id = 3");
  EXPECT_EQ(error_of([&] { Project::open(path_, OpenMode::kRead).pillars(1); }).code(), ErrorCode::kCorrupt);
  tamper("UPDATE pillar SET kind = 0; UPDATE pillar_node SET x = 9e999 WHERE id = 3");
  EXPECT_EQ(error_of([&] { Project::open(path_, OpenMode::kRead).pillars(1); }).code(), ErrorCode::kCorrupt);
  tamper("UPDATE survey SET sample_interval = -1");
  EXPECT_EQ(error_of([&] { Project::open(path_, OpenMode::kRead).survey(); }).code(), ErrorCode::kCorrupt);
  tamper("UPDATE mesh_face SET data = x'0100000000000000000000000000000001000000ffffff7f'");
  EXPECT_EQ(error_of([&] { Project::open(path_, OpenMode::kRead).mesh(1); }).code(), ErrorCode::kCorrupt);
}

TEST_F(HostileFile, AForgedChangesetDoesNoHarm) {
  make();
  std::mt19937 random(9);
  for (int round = 0; round < 20; ++round) {
    std::string digits;
    for (int n = 0; n < 200; ++n) digits += fmt::format("{:02x}", random() % 256);
    tamper("UPDATE edit SET changeset = x'54" + digits + "'");
    auto project = Project::open(path_, OpenMode::kWrite);
    EXPECT_EQ(error_of([&] { project.undo(); }).code(), ErrorCode::kCorrupt);
    EXPECT_EQ(project.faults().size(), 1U);
  }
}

// Any byte may be wrong: the answer is an Error or a project, never a crash or a hang.
TEST_F(HostileFile, RandomDamageNeverCrashes) {
  make();
  const std::string whole = read_whole_file(path_, 1 << 26);
  std::mt19937 random(17);
  int refused_files = 0;
  for (int round = 0; round < rounds(150); ++round) {
    std::string damaged = whole;
    const int places = 1 + static_cast<int>(random() % 30);
    for (int n = 0; n < places; ++n) damaged[random() % damaged.size()] = static_cast<char>(random());
    std::ofstream(path_, std::ios::binary) << damaged;
    try {
      auto project = Project::open(path_, OpenMode::kRead);
      project.check();
    } catch (const Error&) {
      ++refused_files;
    }
  }
  EXPECT_GT(refused_files, 20);
}

}  // namespace
}  // namespace footwall::project
