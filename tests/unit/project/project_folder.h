// A folder of its own for each test, a survey, and a look at the file behind the project's back.
#pragma once
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <filesystem>
#include <string>

#include "scratch_folder.h"
#include "storage/base/error.h"
#include "storage/project/project.h"

namespace footwall::project {

inline survey::Geometry small_survey() {
  survey::Geometry g;
  g.inlines = {100, 2, 40};
  g.crosslines = {300, 1, 50};
  g.samples = 60;
  g.z0 = 12.5;
  g.interval = 4;
  g.map = {606000.25, 6074000.5, 12.3, 21.7, 21.7, -12.3};
  g.crs = "EPSG:32631";
  g.assumed = {"vertical unit"};
  return g;
}

class ProjectFolder : public ::testing::Test {
 protected:
  // Runs SQL on the file as another program would.
  void tamper(const std::string& sql) const {
    sqlite3* db = nullptr;
    ASSERT_EQ(sqlite3_open(path_.c_str(), &db), SQLITE_OK);
    char* message = nullptr;
    EXPECT_EQ(sqlite3_exec(db, sql.c_str(), nullptr, nullptr, &message), SQLITE_OK)
        << (message ? message : "");
    sqlite3_free(message);
    sqlite3_close(db);
  }

  // Every row of the interpretation's tables, as text.
  std::string interpretation() const {
    sqlite3* db = nullptr;
    EXPECT_EQ(sqlite3_open_v2(path_.c_str(), &db, SQLITE_OPEN_READONLY, nullptr), SQLITE_OK);
    std::string all;
    const auto add = [](void* to, int count, char** values, char**) {
      for (int c = 0; c < count; ++c) *static_cast<std::string*>(to) += std::string(values[c]) + "|";
      *static_cast<std::string*>(to) += "\n";
      return 0;
    };
    for (const char* sql :
         {"SELECT 'f', id, quote(name), colour, quote(interpreter), status, quote(note), modified, revision, "
          "locked,"
          " quote(tie_tolerance), hex(chart) FROM fault ORDER BY id",
          "SELECT 'p', id, fault, kind, parent_a, parent_b, quote(parameter), hex(former) FROM pillar ORDER "
          "BY id",
          "SELECT 'n', id, pillar, ordinal, quote(x), quote(y), quote(z) FROM pillar_node ORDER BY id",
          "SELECT 's', id, quote(name), kind, vertices, triangles, fault, horizontal_unit, vertical_unit, "
          "hex(data) FROM surface ORDER BY id"}) {
      EXPECT_EQ(sqlite3_exec(db, sql, add, &all, nullptr), SQLITE_OK);
    }
    sqlite3_close(db);
    return all;
  }

  ScratchFolder folder_;
  std::filesystem::path path_ = folder_ / "demo.footwall";
};

// The error that `call` throws; fails the test when there is none.
template <class Call>
Error error_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "expected an error";
  return {ErrorCode::kInternal, "no error"};
}

}  // namespace footwall::project
