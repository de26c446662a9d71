#include "storage/project/detail/database.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <fmt/format.h>

#include "storage/base/log.h"
#include "storage/project/detail/sqlite.h"

namespace footwall::project::detail {
namespace {

constexpr int kBusyMilliseconds = 5000;

struct Limit {
  int id;
  int value;
};
// What the largest real project needs, with room; a hostile file gets no further.
constexpr Limit kLimits[] = {{SQLITE_LIMIT_LENGTH, static_cast<int>(kLargestValue)},
                             {SQLITE_LIMIT_SQL_LENGTH, 100'000},
                             {SQLITE_LIMIT_COLUMN, 100},
                             {SQLITE_LIMIT_EXPR_DEPTH, 50},
                             {SQLITE_LIMIT_COMPOUND_SELECT, 10},
                             {SQLITE_LIMIT_VDBE_OP, 100'000},
                             {SQLITE_LIMIT_FUNCTION_ARG, 16},
                             {SQLITE_LIMIT_ATTACHED, 0},
                             {SQLITE_LIMIT_LIKE_PATTERN_LENGTH, 100},
                             {SQLITE_LIMIT_VARIABLE_NUMBER, 100},
                             {SQLITE_LIMIT_TRIGGER_DEPTH, 1},
                             {SQLITE_LIMIT_WORKER_THREADS, 0}};

void defend(sqlite3* handle) {
  sqlite3_extended_result_codes(handle, 1);
  for (const Limit& limit : kLimits) sqlite3_limit(handle, limit.id, limit.value);
  const auto set = [&](int option, int value) {
    int now = -1;
    const int rc = sqlite3_db_config(handle, option, value, &now);
    require(rc == SQLITE_OK && now == value, "SQLite refused a defensive setting");
  };
  set(SQLITE_DBCONFIG_DEFENSIVE, 1);
  set(SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0);
  set(SQLITE_DBCONFIG_ENABLE_TRIGGER, 0);
  set(SQLITE_DBCONFIG_ENABLE_VIEW, 0);
  set(SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION, 0);
  set(SQLITE_DBCONFIG_WRITABLE_SCHEMA, 0);
  set(SQLITE_DBCONFIG_DQS_DML, 0);
  set(SQLITE_DBCONFIG_DQS_DDL, 0);
  set(SQLITE_DBCONFIG_ENABLE_FKEY, 1);
}

std::string uri_of(const std::filesystem::path& path) {
  std::string uri = "file:";
  for (const unsigned char c : path.string()) {
    const bool plain = std::isalnum(c) != 0 || c == '/' || c == '.' || c == '_' || c == '-';
    uri += plain ? std::string(1, static_cast<char>(c)) : fmt::format("%{:02x}", c);
  }
  return uri + "?immutable=1";
}

Error translated(int code, const std::string& reason, std::string_view doing, const std::string& path) {
  const std::string message = fmt::format("cannot {} {}: {}", doing, path, reason);
  switch (code & 0xff) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return {ErrorCode::kHeld, message, "another program is using the project: close it, or try again"};
    case SQLITE_CORRUPT:
      return {ErrorCode::kCorrupt, message, "restore the file from a copy"};
    case SQLITE_NOTADB:
      return {ErrorCode::kFormat, message, "a project is made by 'footwall new'"};
    case SQLITE_FULL:
      return {ErrorCode::kIo, message, "free some space on the disk; nothing of this change was kept"};
    case SQLITE_IOERR:
      return {ErrorCode::kIo, message, "the disk may be full or gone; nothing of this change was kept"};
    case SQLITE_CANTOPEN:
    case SQLITE_PERM:
    case SQLITE_READONLY:
    case SQLITE_AUTH:
      return {ErrorCode::kIo, message, "check the permissions of the file and its folder"};
    case SQLITE_NOMEM:
      return {ErrorCode::kMemory, message};
    case SQLITE_TOOBIG:
      return {ErrorCode::kInvalid, message,
              fmt::format("one value may have {} MiB at most", kLargestValue >> 20)};
    default:
      return {ErrorCode::kInternal, message};
  }
}

}  // namespace

Database::Database(const std::filesystem::path& path, Access access) : path_(path) {
  int flags = SQLite::OPEN_READONLY;
  if (access == Access::kWrite) flags = SQLite::OPEN_READWRITE;
  if (access == Access::kCreate) flags = SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE;
  try {
    if (access == Access::kImmutable) {
      database_ =
          std::make_unique<SQLite::Database>(uri_of(path), flags | SQLite::OPEN_URI, kBusyMilliseconds);
    } else {
      database_ = std::make_unique<SQLite::Database>(path.string(), flags, kBusyMilliseconds);
    }
  } catch (const SQLite::Exception& error) {
    throw translated(error.getErrorCode(), error.getErrorStr(), "open", path.string());
  }
  defend(handle());
  exec("PRAGMA cell_size_check = ON; PRAGMA mmap_size = 0; PRAGMA synchronous = FULL");
}

Database::Database() : path_(":memory:") {
  database_ = std::make_unique<SQLite::Database>(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  defend(handle());
}

Database::~Database() = default;

void Database::close() {
  statements_.clear();
  database_.reset();
}

sqlite3* Database::handle() const {
  return database_->getHandle();
}

bool Database::in_transaction() const {
  return sqlite3_get_autocommit(handle()) == 0;
}

Error Database::failure(int code, std::string_view doing) const {
  return translated(code, sqlite3_errstr(code), doing, path_.string());
}

template <class Call>
auto Database::guarded(const Call& call) const {
  try {
    return call();
  } catch (const SQLite::Exception& error) {
    throw translated(error.getErrorCode(), error.what(), "use", path_.string());
  }
}

void Database::vacuum() {
  // SQLite attaches the new file for the moment.
  sqlite3_limit(handle(), SQLITE_LIMIT_ATTACHED, 1);
  try {
    exec("VACUUM");
  } catch (...) {
    sqlite3_limit(handle(), SQLITE_LIMIT_ATTACHED, 0);
    throw;
  }
  sqlite3_limit(handle(), SQLITE_LIMIT_ATTACHED, 0);
}

void Database::exec(const std::string& sql) {
  guarded([&] { database_->exec(sql); });
}

std::int64_t Database::integer(const std::string& sql) {
  Query query(*this, sql);
  require(query.next(), "a query for one number gave no row");
  return query.integer(0);
}

std::string Database::text(const std::string& sql) {
  Query query(*this, sql);
  require(query.next(), "a query for one text gave no row");
  return query.text(0);
}

SQLite::Statement& Database::prepared(std::string_view sql) {
  const auto known = statements_.find(sql);
  if (known != statements_.end()) return *known->second;
  auto statement = guarded([&] { return std::make_unique<SQLite::Statement>(*database_, std::string(sql)); });
  return *statements_.emplace(std::string(sql), std::move(statement)).first->second;
}

Query::Query(Database& database, std::string_view sql, Start)
    : database_(database), statement_(database.prepared(sql)) {
  reset();
}

Query::~Query() {
  // A statement left half-way would keep its read transaction open.
  statement_.tryReset();
  statement_.clearBindings();
}

void Query::reset() {
  statement_.tryReset();
  statement_.clearBindings();
}

bool Query::next() {
  return database_.guarded([&] { return statement_.executeStep(); });
}

void Query::run() {
  if (next()) require(false, "a statement without rows gave one");
}

void Query::bind(int at, std::int64_t value) {
  database_.guarded([&] { statement_.bind(at, value); });
}
void Query::bind(int at, double value) {
  database_.guarded([&] { statement_.bind(at, value); });
}
void Query::bind(int at, const std::string& value) {
  database_.guarded([&] { statement_.bind(at, value); });
}
void Query::bind(int at, const std::optional<double>& value) {
  if (value) bind(at, *value);  // otherwise it stays NULL
}
void Query::bind(int at, const Bytes& value) {
  if (value.size() > static_cast<std::size_t>(kLargestValue)) {
    throw Error(
        ErrorCode::kInvalid,
        fmt::format("a value of {} MiB is too large for {}", value.size() >> 20, database_.path().string()),
        fmt::format("one value may have {} MiB at most", kLargestValue >> 20));
  }
  static constexpr std::byte kNothing{};
  database_.guarded([&] {
    statement_.bindNoCopy(at, value.empty() ? static_cast<const void*>(&kNothing) : value.data(),
                          static_cast<int>(value.size()));
  });
}

bool Query::null(int column) const {
  return statement_.getColumn(column).isNull();
}
std::int64_t Query::integer(int column) const {
  return statement_.getColumn(column).getInt64();
}
double Query::real(int column) const {
  return statement_.getColumn(column).getDouble();
}
std::string Query::text(int column) const {
  return statement_.getColumn(column).getString();
}
std::optional<double> Query::optional_real(int column) const {
  return null(column) ? std::nullopt : std::optional(real(column));
}
std::span<const std::byte> Query::view(int column) const {
  const auto value = statement_.getColumn(column);
  const void* data = value.getBlob();
  return {static_cast<const std::byte*>(data),
          data == nullptr ? 0 : static_cast<std::size_t>(value.getBytes())};
}
Bytes Query::blob(int column) const {
  const auto bytes = view(column);
  return {bytes.begin(), bytes.end()};
}

Transaction::Transaction(Database& database) : database_(database) {
  database_.exec("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  if (!open_ || !database_.in_transaction()) return;
  try {
    database_.exec("ROLLBACK");
  } catch (const Error& error) {
    log::error(error.what());
  }
}

void Transaction::commit() {
  database_.exec("COMMIT");
  open_ = false;
}

}  // namespace footwall::project::detail
