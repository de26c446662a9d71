#include "storage/project/detail/undo_log.h"

#include <fmt/format.h>
#include <cstring>
#include <limits>

#include "storage/project/detail/changeset.h"
#include "storage/project/detail/clock.h"
#include "storage/project/detail/schema.h"
#include "storage/project/detail/sqlite.h"

namespace footwall::project::detail {
namespace {

// SQLite's own allocation, copied and freed.
Bytes adopted(void* data, int size) {
  const auto* begin = static_cast<const std::byte*>(data);
  Bytes bytes(begin, begin + size);
  sqlite3_free(data);
  return bytes;
}

Bytes inverted(Database& database, Bytes& changeset) {
  void* data = nullptr;
  int size = 0;
  const int rc = sqlite3changeset_invert(static_cast<int>(changeset.size()), changeset.data(), &size, &data);
  if (rc != SQLITE_OK) throw database.failure(rc, "read the undo log of");
  return adopted(data, size);
}

// A step fits exactly what the step before it left; anything else means that the file was changed behind our
// back.
int refuse_conflict(void* conflicts, int, sqlite3_changeset_iter*) {
  ++*static_cast<int*>(conflicts);
  return SQLITE_CHANGESET_ABORT;
}

// A changeset from an untrusted file must not reach tables outside undo.
int only_under_undo(void*, const char* table) {
  for (const char* known : tables_under_undo()) {
    if (std::strcmp(known, table) == 0) return 1;
  }
  return 0;
}

}  // namespace

ChangeRecorder::ChangeRecorder(Database& database) : database_(database) {
  int rc = sqlite3session_create(database.handle(), "main", &session_);
  for (const char* table : tables_under_undo()) {
    if (rc == SQLITE_OK) rc = sqlite3session_attach(session_, table);
  }
  if (rc != SQLITE_OK) {
    sqlite3session_delete(session_);
    throw database.failure(rc, "record changes of");
  }
}

ChangeRecorder::~ChangeRecorder() {
  sqlite3session_delete(session_);
}

Bytes ChangeRecorder::changeset() const {
  void* data = nullptr;
  int size = 0;
  const int rc = sqlite3session_changeset(session_, &size, &data);
  if (rc != SQLITE_OK) throw database_.failure(rc, "record changes of");
  return adopted(data, size);
}

void UndoLog::check(const Bytes& changeset) const {
  std::vector<ChangesetTable> tables;
  for (const char* table : tables_under_undo()) {
    const auto columns =
        database_.integer(fmt::format("SELECT count(*) FROM pragma_table_info('{}')", table));
    tables.push_back({table, static_cast<std::size_t>(columns)});
  }
  check_changeset(changeset, tables);
}

std::int64_t UndoLog::add(const std::string& name, const Bytes& changeset) {
  if (const std::int64_t undone = first_undone(); undone != 0) {
    Query(database_, "DELETE FROM edit WHERE id >= ?", undone).run();
  }
  Query(database_, "INSERT INTO edit(name, made, undone, barrier, changeset) VALUES(?, ?, 0, 0, ?)", name,
        now_text(), changeset)
      .run();
  return database_.integer("SELECT last_insert_rowid()");
}

// Undone steps are the last ones, so that halving finds where they begin: looking through all of them would
// make each step slower than the one before it.
std::int64_t UndoLog::first_undone() const {
  const auto is_undone = [this](std::int64_t from) {
    Query row(database_, "SELECT undone FROM edit WHERE id >= ? ORDER BY id LIMIT 1", from);
    return row.next() && row.integer(0) != 0;
  };
  std::int64_t low = 0;  // some id from which on the next step is not undone, or 0
  std::int64_t high = database_.integer("SELECT coalesce(max(id), 0) FROM edit");
  if (high <= 0 || !is_undone(high)) return 0;
  while (high - low > 1) {
    const std::int64_t middle = low + (high - low) / 2;
    (is_undone(middle) ? high : low) = middle;
  }
  Query row(database_, "SELECT id FROM edit WHERE id >= ? ORDER BY id LIMIT 1", high);
  return row.next() ? row.integer(0) : 0;
}

std::optional<std::string> UndoLog::undo() {
  std::int64_t id = 0;
  std::string name;
  Bytes changeset;
  {
    const std::int64_t undone = first_undone();
    Query row(database_,
              "SELECT id, name, barrier, changeset FROM edit WHERE id < ? ORDER BY id DESC LIMIT 1",
              undone == 0 ? std::numeric_limits<std::int64_t>::max() : undone);
    if (!row.next() || row.integer(2) != 0) return std::nullopt;
    id = row.integer(0);
    name = row.text(1);
    changeset = row.blob(3);
  }
  check(changeset);
  apply(inverted(database_, changeset), name);
  Query(database_, "UPDATE edit SET undone = 1 WHERE id = ?", id).run();
  return name;
}

std::optional<std::string> UndoLog::redo() {
  std::int64_t id = 0;
  std::string name;
  Bytes changeset;
  {
    Query row(database_, "SELECT id, name, changeset FROM edit WHERE id = ?", first_undone());
    if (!row.next()) return std::nullopt;
    id = row.integer(0);
    name = row.text(1);
    changeset = row.blob(2);
  }
  check(changeset);
  apply(changeset, name);
  Query(database_, "UPDATE edit SET undone = 0 WHERE id = ?", id).run();
  return name;
}

void UndoLog::apply(const Bytes& changeset, const std::string& name) {
  int conflicts = 0;
  Bytes input = changeset;  // SQLite's signature wants it writable
  const int rc = sqlite3changeset_apply(database_.handle(), static_cast<int>(input.size()), input.data(),
                                        only_under_undo, refuse_conflict, &conflicts);
  if (conflicts > 0 || rc == SQLITE_CORRUPT || rc == SQLITE_ABORT) {
    throw Error(
        ErrorCode::kCorrupt,
        fmt::format(
            "the step '{}' does not fit the interpretation: the project was changed by another program",
            name),
        "restore the project from a copy");
  }
  if (rc != SQLITE_OK) throw database_.failure(rc, "apply a step of the undo log to");
}

std::vector<HistoryStep> UndoLog::steps(std::int64_t first) const {
  std::vector<HistoryStep> steps;
  Query row(database_, "SELECT id, name, made, undone, barrier FROM edit WHERE id >= ? ORDER BY id", first);
  while (row.next()) {
    steps.push_back({row.integer(0), row.text(1), row.text(2), row.integer(3) != 0, row.integer(4) != 0});
  }
  return steps;
}

namespace {

// Steps below this number would be dropped: they are older than `before`, and none before them is not.
constexpr const char* kFirstKept =
    "SELECT coalesce(min(id), 9223372036854775807) FROM edit WHERE undone = 1 OR made >= ?";

}  // namespace

HistorySize UndoLog::size(const std::optional<std::string>& before) const {
  constexpr const char* kSize =
      "SELECT count(*), coalesce(sum(length(changeset) + length(name)), 0) FROM edit WHERE id < ?";
  std::int64_t end = std::numeric_limits<std::int64_t>::max();
  if (before) {
    Query row(database_, kFirstKept, *before);
    require(row.next(), "a query for one number gave no row");
    end = row.integer(0);
  }
  Query row(database_, kSize, end);
  require(row.next(), "a query for one row gave none");
  return {row.integer(0), row.integer(1)};
}

HistorySize UndoLog::trim(const std::string& before) {
  const HistorySize dropped = size(before);
  if (dropped.steps == 0) return dropped;
  std::int64_t end = 0;
  {
    Query row(database_, kFirstKept, before);
    require(row.next(), "a query for one number gave no row");
    end = row.integer(0);
  }
  Query(database_, "DELETE FROM edit WHERE id < ?", end).run();
  Query(database_, "INSERT INTO event(made, what) VALUES(?, ?)", now_text(),
        fmt::format("{} steps of the history before {} dropped", dropped.steps, before))
      .run();
  return dropped;
}

}  // namespace footwall::project::detail
