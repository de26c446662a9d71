// One SQLite connection, opened defensively, and the statements run on it. The only way to SQLite in this
// folder; SQLite's errors leave here as footwall::Error.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "storage/base/error.h"
#include "storage/project/records.h"

namespace SQLite {
class Database;
class Statement;
}  // namespace SQLite
struct sqlite3;

namespace footwall::project::detail {

// No stored value is larger; a project never holds one near it.
inline constexpr std::int64_t kLargestValue = std::int64_t{512} << 20;

enum class Access : std::uint8_t { kCreate, kWrite, kRead, kImmutable };

class Database {
 public:
  // Opens with every defence on: defensive mode, untrusted schema, no triggers, no views, low limits.
  Database(const std::filesystem::path& path, Access access);
  // A private database in memory.
  Database();
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  // Runs statements that return nothing of interest.
  void exec(const std::string& sql);
  std::int64_t integer(const std::string& sql);
  std::string text(const std::string& sql);
  bool in_transaction() const;
  sqlite3* handle() const;
  const std::filesystem::path& path() const { return path_; }
  // Error for the result code of a call to SQLite itself: "cannot <doing> PATH: reason".
  Error failure(int code, std::string_view doing) const;
  // Rewrites the file without its free pages. Not within a transaction. Throws kHeld while somebody reads.
  void vacuum();
  // Finalizes the kept statements and closes.
  void close();

 private:
  friend class Query;
  SQLite::Statement& prepared(std::string_view sql);
  template <class Call>
  auto guarded(const Call& call) const;
  std::filesystem::path path_;
  std::unique_ptr<SQLite::Database> database_;
  std::map<std::string, std::unique_ptr<SQLite::Statement>, std::less<>> statements_;
};

// One run of one statement: bind with the constructor, walk with next(), read by column from 0. The statement
// is kept prepared for the next run; the same text must not be nested in itself.
class Query {
 public:
  template <class... Values>
  Query(Database& database, std::string_view sql, const Values&... values) : Query(database, sql, Start{}) {
    int at = 0;
    (bind(++at, values), ...);
  }
  ~Query();
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;

  // The next row, false after the last.
  bool next();
  // Runs a statement without rows.
  void run();
  // Runs again with other values.
  template <class... Values>
  void run_with(const Values&... values) {
    reset();
    int at = 0;
    (bind(++at, values), ...);
    run();
  }

  bool null(int column) const;
  std::int64_t integer(int column) const;
  double real(int column) const;
  std::string text(int column) const;
  std::optional<double> optional_real(int column) const;
  Bytes blob(int column) const;
  // Valid until the next step.
  std::span<const std::byte> view(int column) const;

 private:
  struct Start {};
  Query(Database& database, std::string_view sql, Start);
  void bind(int at, std::int64_t value);
  void bind(int at, int value) { bind(at, static_cast<std::int64_t>(value)); }
  void bind(int at, bool value) { bind(at, static_cast<std::int64_t>(value)); }
  void bind(int at, double value);
  void bind(int at, const std::string& value);
  void bind(int at, const std::optional<double>& value);
  void bind(int at, const Bytes& value);  // not copied: must outlive the run
  void reset();
  Database& database_;
  SQLite::Statement& statement_;
};

// BEGIN IMMEDIATE ... COMMIT; rolled back unless commit() was reached.
class Transaction {
 public:
  explicit Transaction(Database& database);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database& database_;
  bool open_ = true;
};

}  // namespace footwall::project::detail
