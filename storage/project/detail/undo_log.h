// The log of interpretation changes: one SQLite changeset per step, kept in the table `edit`.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "storage/project/detail/database.h"

struct sqlite3_session;

namespace footwall::project::detail {

// Watches the tables under undo from its construction on.
class ChangeRecorder {
 public:
  explicit ChangeRecorder(Database& database);
  ~ChangeRecorder();
  ChangeRecorder(const ChangeRecorder&) = delete;
  ChangeRecorder& operator=(const ChangeRecorder&) = delete;
  // The net difference so far; empty when nothing differs.
  Bytes changeset() const;

 private:
  Database& database_;
  sqlite3_session* session_ = nullptr;
};

// All calls that write must stand inside a transaction, which the caller commits.
class UndoLog {
 public:
  explicit UndoLog(Database& database) : database_(database) {}
  // Adds a step and drops those that could be redone. Returns its id.
  std::int64_t add(const std::string& name, const Bytes& changeset);
  // Takes back the last step, or brings back the first undone one; its name, nothing when there is none.
  // Throws kCorrupt when the tables do not hold what the step left.
  std::optional<std::string> undo();
  std::optional<std::string> redo();
  // Those of this number and later ones, oldest first.
  std::vector<HistoryStep> steps(std::int64_t first) const;
  // See Project::history_size() and trim_history().
  HistorySize size(const std::optional<std::string>& before) const;
  HistorySize trim(const std::string& before);

 private:
  std::int64_t first_undone() const;  // 0 where none is
  void check(const Bytes& changeset) const;
  void apply(const Bytes& changeset, const std::string& name);
  Database& database_;
};

}  // namespace footwall::project::detail
