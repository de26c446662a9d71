#include "storage/project/detail/changeset.h"

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <random>

#include "storage/project/detail/schema.h"
#include "storage/project/detail/undo_log.h"
#include "unit/project/project_folder.h"

namespace footwall::project::detail {
namespace {

// A changeset as SQLite writes it, with every operation and value type.
class ChangesetTest : public ::testing::Test {
 protected:
  ChangesetTest() {
    create_schema(database_);
    add(1, "F1");
    add(2, "F2");
    Transaction transaction(database_);
    const ChangeRecorder recorder(database_);
    add(3, "F3");
    database_.exec("DELETE FROM fault WHERE id = 1; UPDATE fault SET note = 'n', revision = 9 WHERE id = 2");
    changeset_ = recorder.changeset();
    transaction.commit();
  }
  void add(int id, const std::string& name) {
    database_.exec(fmt::format("INSERT INTO fault VALUES({}, '{}', '', '', '', '', '', 1, 0, 2.5, x'010203')",
                               id, name));
  }
  Database database_;
  Bytes changeset_;
  std::vector<ChangesetTable> tables_{{"fault", 11}, {"pillar", 7}};
};

TEST_F(ChangesetTest, WhatSqliteWroteIsAccepted) {
  EXPECT_NO_THROW(check_changeset(changeset_, tables_));
  tables_[0].columns = 12;
  EXPECT_NO_THROW(check_changeset(changeset_, tables_)) << "columns may have been appended since";
}

TEST_F(ChangesetTest, OtherTablesAndMoreColumnsAreRefused) {
  EXPECT_THROW(check_changeset(changeset_, std::span(tables_).subspan(1)), Error);
  tables_[0].columns = 10;
  EXPECT_THROW(check_changeset(changeset_, tables_), Error);
}

TEST_F(ChangesetTest, EveryTruncationThatCutsARowIsRefused) {
  int accepted = 0;
  for (std::size_t size = 0; size < changeset_.size(); ++size) {
    try {
      check_changeset(std::span(changeset_).first(size), tables_);
      ++accepted;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kCorrupt);
    }
  }
  EXPECT_EQ(accepted, 3) << "only the ends of the header and of the first two rows are whole";
}

TEST_F(ChangesetTest, AlteredOnesThatPassDoNotHarmSqlite) {
  std::mt19937 random(23);
  for (int round = 0; round < 2000; ++round) {
    Bytes altered = changeset_;
    for (int n = 0; n < 3; ++n) altered[random() % altered.size()] = static_cast<std::byte>(random());
    try {
      check_changeset(altered, tables_);
    } catch (const Error&) {
      continue;
    }
    Transaction transaction(database_);
    Query(database_, "DELETE FROM edit").run();
    UndoLog log(database_);
    log.add("altered", altered);
    try {
      log.undo();
    } catch (const Error&) {
      continue;  // refused by SQLite: it does not fit the tables
    }
  }
  EXPECT_EQ(database_.text("PRAGMA integrity_check"), "ok");
}

}  // namespace
}  // namespace footwall::project::detail
