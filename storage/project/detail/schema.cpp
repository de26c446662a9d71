#include "storage/project/detail/schema.h"

#include <fmt/format.h>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>

#include "storage/base/error.h"
#include "storage/base/partial_file.h"
#include "storage/project/detail/clock.h"
#include "storage/project/detail/sqlite.h"

namespace footwall::project::detail {
namespace {

// Tables under undo (fault, pillar, pillar_node, surface): explicit NOT NULL primary key, no other UNIQUE, no
// triggers, no cascades, so that a changeset applies as it was recorded. Nothing outside them may refer to
// them with a foreign key: undo removes rows that meshes and runs still speak of.
constexpr const char* kSchema = R"sql(
CREATE TABLE survey(
  id INTEGER PRIMARY KEY NOT NULL CHECK(id = 1),
  inline_first INTEGER NOT NULL, inline_step INTEGER NOT NULL, inline_count INTEGER NOT NULL,
  crossline_first INTEGER NOT NULL, crossline_step INTEGER NOT NULL, crossline_count INTEGER NOT NULL,
  samples INTEGER NOT NULL, z0 REAL NOT NULL, sample_interval REAL NOT NULL,
  domain TEXT NOT NULL, vertical_unit TEXT NOT NULL,
  origin_x REAL NOT NULL, origin_y REAL NOT NULL,
  per_inline_x REAL NOT NULL, per_inline_y REAL NOT NULL,
  per_crossline_x REAL NOT NULL, per_crossline_y REAL NOT NULL,
  crs TEXT NOT NULL, horizontal_unit TEXT NOT NULL, assumed TEXT NOT NULL, provenance TEXT NOT NULL) STRICT;
CREATE TABLE setting(name TEXT PRIMARY KEY NOT NULL, value TEXT NOT NULL) STRICT;
CREATE TABLE volume(
  id INTEGER PRIMARY KEY NOT NULL, name TEXT NOT NULL UNIQUE, file TEXT NOT NULL,
  inlines INTEGER NOT NULL, crosslines INTEGER NOT NULL, samples INTEGER NOT NULL,
  origin_i INTEGER NOT NULL, origin_j INTEGER NOT NULL, origin_k INTEGER NOT NULL,
  bytes INTEGER NOT NULL, checksum TEXT NOT NULL,
  min REAL, max REAL, mean REAL, stddev REAL, max_abs REAL,
  null_count INTEGER NOT NULL, live_traces INTEGER NOT NULL, null_value REAL,
  role TEXT NOT NULL, source TEXT NOT NULL, provenance TEXT NOT NULL) STRICT;
CREATE TABLE fault(
  id INTEGER PRIMARY KEY NOT NULL, name TEXT NOT NULL, colour TEXT NOT NULL, interpreter TEXT NOT NULL,
  status TEXT NOT NULL, note TEXT NOT NULL, modified TEXT NOT NULL, revision INTEGER NOT NULL,
  locked INTEGER NOT NULL, tie_tolerance REAL NOT NULL, chart BLOB NOT NULL) STRICT;
CREATE TABLE pillar(
  id INTEGER PRIMARY KEY NOT NULL, fault INTEGER NOT NULL REFERENCES fault(id), kind INTEGER NOT NULL,
  parent_a INTEGER NOT NULL, parent_b INTEGER NOT NULL, parameter REAL NOT NULL, former BLOB NOT NULL) STRICT;
CREATE INDEX pillar_of_fault ON pillar(fault);
CREATE INDEX pillar_of_parent_a ON pillar(parent_a) WHERE parent_a <> 0;
CREATE INDEX pillar_of_parent_b ON pillar(parent_b) WHERE parent_b <> 0;
CREATE TABLE pillar_node(
  id INTEGER PRIMARY KEY NOT NULL, pillar INTEGER NOT NULL REFERENCES pillar(id), ordinal INTEGER NOT NULL,
  x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL) STRICT;
CREATE INDEX node_of_pillar ON pillar_node(pillar, ordinal);
CREATE TABLE surface(
  id INTEGER PRIMARY KEY NOT NULL, name TEXT NOT NULL, kind TEXT NOT NULL,
  vertices INTEGER NOT NULL, triangles INTEGER NOT NULL, data BLOB NOT NULL) STRICT;
CREATE TABLE truth(
  id INTEGER PRIMARY KEY NOT NULL, name TEXT NOT NULL, kind TEXT NOT NULL,
  vertices INTEGER NOT NULL, triangles INTEGER NOT NULL, data BLOB NOT NULL) STRICT;
CREATE TABLE id_counter(family TEXT PRIMARY KEY NOT NULL, last INTEGER NOT NULL) STRICT;
CREATE TABLE edit(
  id INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, name TEXT NOT NULL, made TEXT NOT NULL,
  undone INTEGER NOT NULL, barrier INTEGER NOT NULL, changeset BLOB NOT NULL) STRICT;
CREATE TABLE event(
  id INTEGER PRIMARY KEY NOT NULL, made TEXT NOT NULL, what TEXT NOT NULL) STRICT;
CREATE TABLE mesh(
  fault INTEGER PRIMARY KEY NOT NULL, revision INTEGER NOT NULL, algorithm TEXT NOT NULL,
  parameters TEXT NOT NULL, made TEXT NOT NULL, chart BLOB NOT NULL) STRICT;
CREATE TABLE mesh_vertex(
  fault INTEGER PRIMARY KEY NOT NULL REFERENCES mesh(fault), count INTEGER NOT NULL, data BLOB NOT NULL) STRICT;
CREATE TABLE mesh_face(
  fault INTEGER PRIMARY KEY NOT NULL REFERENCES mesh(fault), count INTEGER NOT NULL, data BLOB NOT NULL) STRICT;
CREATE TABLE statistic(
  name TEXT PRIMARY KEY NOT NULL, version INTEGER NOT NULL, unit_rule TEXT NOT NULL, low REAL, high REAL,
  colour_map TEXT NOT NULL, description TEXT NOT NULL) STRICT;
CREATE TABLE extraction(
  id INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, name TEXT NOT NULL, live INTEGER NOT NULL, volume TEXT NOT NULL,
  volume_checksum TEXT NOT NULL, parameters TEXT NOT NULL, result TEXT NOT NULL, made TEXT NOT NULL) STRICT;
CREATE TABLE extraction_fault(
  run INTEGER NOT NULL REFERENCES extraction(id), fault INTEGER NOT NULL, fault_name TEXT NOT NULL,
  revision INTEGER NOT NULL, faces INTEGER NOT NULL, face_ids BLOB NOT NULL, lattice BLOB NOT NULL,
  PRIMARY KEY(run, fault)) STRICT;
CREATE TABLE face_statistics(
  run INTEGER NOT NULL, fault INTEGER NOT NULL, statistic TEXT NOT NULL REFERENCES statistic(name),
  data BLOB NOT NULL, PRIMARY KEY(run, fault, statistic),
  FOREIGN KEY(run, fault) REFERENCES extraction_fault(run, fault)) STRICT;
)sql";

// 2: An imported surface belongs to a fault without pillars (0: to none), and knows the units of its
// coordinates.
const Migration kOwnMigrations[] = {
    {2, "imported surfaces belong to faults",
     "ALTER TABLE surface ADD COLUMN fault INTEGER NOT NULL DEFAULT 0;"
     "ALTER TABLE surface ADD COLUMN horizontal_unit TEXT NOT NULL DEFAULT 'm';"
     "ALTER TABLE surface ADD COLUMN vertical_unit TEXT NOT NULL DEFAULT 'm';",
     false,
     "CREATE TEMP VIEW surface AS SELECT id, name, kind, vertices, triangles, data, 0 AS fault,"
     " 'm' AS horizontal_unit, 'm' AS vertical_unit FROM main.surface;"},
    {3, "runs may keep the voxels of their faces",
     "CREATE TABLE face_voxels("
     "run INTEGER NOT NULL, fault INTEGER NOT NULL, codec TEXT NOT NULL, parameters TEXT NOT NULL,"
     " ends BLOB NOT NULL, data BLOB NOT NULL, PRIMARY KEY(run, fault, codec),"
     " FOREIGN KEY(run, fault) REFERENCES extraction_fault(run, fault)) STRICT;",
     false,
     "CREATE TEMP VIEW face_voxels AS SELECT 0 AS run, 0 AS fault, '' AS codec, '' AS parameters,"
     " x'' AS ends, x'' AS data WHERE 0;"},
    {4, "cameras are saved by name",
     "CREATE TABLE view("
     "name TEXT PRIMARY KEY NOT NULL, camera TEXT NOT NULL, exaggeration REAL NOT NULL, made TEXT NOT NULL) "
     "STRICT;",
     false,
     "CREATE TEMP VIEW view AS SELECT '' AS name, '' AS camera, 0.0 AS exaggeration, '' AS made WHERE 0;"}};

constexpr const char* kUndoTables[] = {"fault", "pillar", "pillar_node", "surface"};

// What stands in sqlite_schema: "table fault" -> its definition. SQLite keeps a definition as it was given.
using Objects = std::map<std::string, std::string>;

Objects objects_of(Database& database) {
  Objects objects;
  Query rows(database, "SELECT type, name, tbl_name, coalesce(sql, '') FROM sqlite_schema");
  while (rows.next()) {
    objects[fmt::format("{} {}", rows.text(0), rows.text(1))] =
        fmt::format("on {}: {}", rows.text(2), rows.text(3));
  }
  return objects;
}

Objects expected_objects(int version, std::span<const Migration> migrations) {
  Database model;
  model.exec(kSchema);
  for (const Migration& migration : migrations) {
    if (migration.to <= version) model.exec(migration.sql);
  }
  return objects_of(model);
}

// "view evil is too much"; empty when both are alike. Names come from the file: cut and plain.
std::string difference(const Objects& found, const Objects& expected) {
  const auto plain = [](std::string name) {
    if (name.size() > 80) name.resize(80);
    for (char& c : name) {
      if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e) c = '?';
    }
    return name;
  };
  for (const auto& [name, definition] : expected) {
    const auto there = found.find(name);
    if (there == found.end()) return name + " is missing";
    if (there->second != definition) return name + " is another one";
  }
  for (const auto& [name, definition] : found) {
    if (!expected.contains(name)) return plain(name) + " is too much";
  }
  return {};
}

std::uint32_t big_endian(const unsigned char* bytes) {
  return (std::uint32_t{bytes[0]} << 24) | (std::uint32_t{bytes[1]} << 16) | (std::uint32_t{bytes[2]} << 8) |
         std::uint32_t{bytes[3]};
}

Error newer(const std::string& path, std::int64_t version, int newest) {
  return {
      ErrorCode::kUnsupported,
      fmt::format("{} was made by a newer Footwall: its schema is version {}, this program knows up to {}",
                  path, version, newest),
      "open it with that version, or a later one"};
}

// A read transaction: all reads within see the same state.
class Snapshot {
 public:
  explicit Snapshot(Database& database) : database_(database) {
    if (database_.in_transaction()) return;
    database_.exec("BEGIN");
    begun_ = true;
    database_.integer("SELECT count(*) FROM sqlite_schema");  // BEGIN alone reads nothing yet
  }
  ~Snapshot() {
    if (begun_) sqlite3_exec(database_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
  }
  Snapshot(const Snapshot&) = delete;
  Snapshot& operator=(const Snapshot&) = delete;

 private:
  Database& database_;
  bool begun_ = false;
};

using Header = std::array<unsigned char, 100>;  // of an SQLite file

struct Lack {
  std::uint64_t size = 0;
  std::uint64_t expected = 0;
  friend bool operator==(const Lack&, const Lack&) = default;
};

// How much shorter the file is than its header says. A log or journal left by a crash still holds what the
// file lacks; SQLite puts it right. Without one, the page count stands for the file where both change
// counters agree.
std::optional<Lack> lack_of(const std::filesystem::path& path) {
  std::error_code trouble;
  for (const char* suffix : {"-wal", "-journal"}) {
    const auto left = std::filesystem::file_size(path.string() + suffix, trouble);
    if (!trouble && left > 0) return std::nullopt;
  }
  Header head{};
  std::ifstream file(path, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(head.data()), head.size())) return Lack{};
  const auto size = std::filesystem::file_size(path, trouble);
  const std::uint32_t raw_page = (std::uint32_t{head[16]} << 8) | head[17];
  const std::uint64_t page = raw_page == 1 ? 65536 : raw_page;
  const bool counted = big_endian(&head[24]) == big_endian(&head[92]);
  const std::uint64_t expected = page * big_endian(&head[28]);
  if (!trouble && size % std::max<std::uint64_t>(page, 512) == 0 && (!counted || size >= expected))
    return std::nullopt;
  return Lack{trouble ? 0 : size, expected};
}

}  // namespace

std::span<const char* const> tables_under_undo() {
  return kUndoTables;
}

void check_header(const std::filesystem::path& path, int newest_version) {
  const std::string name = path.string();
  std::error_code trouble;
  if (!std::filesystem::exists(path, trouble)) {
    throw Error(ErrorCode::kNotFound, fmt::format("there is no project {}", name), "footwall new makes one");
  }
  const Error foreign(ErrorCode::kFormat, fmt::format("{} is not a Footwall project", name),
                      "a project is made by 'footwall new'");
  if (!std::filesystem::is_regular_file(path, trouble)) throw foreign;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw io_error("open", name, errno);
  Header head{};
  if (!file.read(reinterpret_cast<char*>(head.data()), head.size())) throw foreign;
  if (std::memcmp(head.data(), "SQLite format 3", 16) != 0) throw foreign;
  if (big_endian(&head[68]) != static_cast<std::uint32_t>(kApplicationId)) {
    throw Error(ErrorCode::kFormat, fmt::format("{} is a database of another program", name),
                "a project is made by 'footwall new'");
  }
  const auto version = static_cast<std::int32_t>(big_endian(&head[60]));
  if (version > newest_version) throw newer(name, version, newest_version);
  // A process that writes meanwhile may have come between the looks at the size and at the header.
  const auto lacking = lack_of(path);
  if (lacking && lack_of(path) == lacking) {
    throw Error(
        ErrorCode::kCorrupt,
        fmt::format("{} is cut short: it has {} bytes, expected {}", name, lacking->size, lacking->expected),
        "restore it from a copy");
  }
}

std::vector<Migration> all_migrations(std::span<const Migration> further) {
  std::vector<Migration> all(std::begin(kOwnMigrations), std::end(kOwnMigrations));
  all.insert(all.end(), further.begin(), further.end());
  return all;
}

void back_up(Database& database, const std::filesystem::path& to, const JobContext& job) {
  constexpr int kPagesAtOnce = 256;
  PartialFile file(to);
  std::unique_ptr<sqlite3, int (*)(sqlite3*)> copy(
      [&] {
        sqlite3* opened = nullptr;
        sqlite3_open_v2(file.path().c_str(), &opened, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
        return opened;
      }(),
      sqlite3_close);
  const auto checked = [&](int rc) {
    if (rc != SQLITE_OK) throw database.failure(rc, "copy");
  };
  checked(sqlite3_errcode(copy.get()));
  {
    // One read transaction around all steps: what is committed meanwhile stays out, and does not start the
    // copy anew.
    const Snapshot snapshot(database);
    sqlite3_backup* backup = sqlite3_backup_init(copy.get(), "main", database.handle(), "main");
    if (backup == nullptr) checked(sqlite3_errcode(copy.get()));
    const std::unique_ptr<sqlite3_backup, int (*)(sqlite3_backup*)> ended(backup, sqlite3_backup_finish);
    job.report(0, "copy the project");
    for (;;) {
      const int rc = sqlite3_backup_step(backup, kPagesAtOnce);
      if (rc == SQLITE_DONE) break;
      checked(rc);
      const int pages = std::max(sqlite3_backup_pagecount(backup), 1);
      job.report(1 - static_cast<double>(sqlite3_backup_remaining(backup)) / pages, "copy the project");
    }
  }
  // The copy still says that it is written through a log, as the original is.
  checked(sqlite3_exec(copy.get(), "PRAGMA journal_mode = DELETE", nullptr, nullptr, nullptr));
  copy.reset();
  file.commit();
}

void create_schema(Database& database) {
  database.exec(kSchema);
  for (const Migration& migration : kOwnMigrations) database.exec(migration.sql);
  database.exec(
      fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}", kApplicationId, kSchemaVersion));
}

int verify(Database& database, std::span<const Migration> migrations) {
  const std::string name = database.path().string();
  const int newest = migrations.empty() ? kSchemaVersion : migrations.back().to;
  if (database.integer("PRAGMA application_id") != kApplicationId) {
    throw Error(ErrorCode::kFormat, fmt::format("{} is a database of another program", name));
  }
  const std::int64_t version = database.integer("PRAGMA user_version");
  if (version > newest) throw newer(name, version, newest);
  if (version < 1) throw Error(ErrorCode::kFormat, fmt::format("{} has no schema version", name));
  const Objects expected = expected_objects(static_cast<int>(version), migrations);
  if (const std::string wrong = difference(objects_of(database), expected); !wrong.empty()) {
    throw Error(ErrorCode::kFormat, fmt::format("{} does not have the tables of a project: {}", name, wrong),
                "it was changed by another program; restore it from a copy");
  }
  const std::string state = database.text("PRAGMA quick_check(1)");
  if (state != "ok") {
    throw Error(ErrorCode::kCorrupt, fmt::format("{} is damaged: {}", name, state), "restore it from a copy");
  }
  return static_cast<int>(version);
}

bool show_as_newest(Database& database, int from, std::span<const Migration> migrations) {
  for (const Migration& migration : migrations) {
    if (migration.to > from && migration.for_readers.empty()) return false;
  }
  for (const Migration& migration : migrations) {
    if (migration.to > from) database.exec(migration.for_readers);
  }
  return true;
}

std::filesystem::path migrate(Database& database, int from, std::span<const Migration> migrations) {
  std::filesystem::path backup = fmt::format("{}.backup-v{}", database.path().string(), from);
  for (int n = 2; std::filesystem::exists(backup); ++n) {
    backup = fmt::format("{}.backup-v{}-{}", database.path().string(), from, n);
  }
  back_up(database, backup, JobContext());
  Transaction transaction(database);
  int version = from;
  for (const Migration& migration : migrations) {
    if (migration.to <= from) continue;
    require(migration.to == version + 1, "migrations must be numbered without gaps");
    database.exec(migration.sql);
    if (migration.ends_history) {
      Query(database, "INSERT INTO edit(name, made, undone, barrier, changeset) VALUES(?, ?, 0, 1, x'')",
            fmt::format("history ends here: {}", migration.name), now_text())
          .run();
      Query(database, "DELETE FROM edit WHERE undone = 1").run();
    }
    version = migration.to;
  }
  database.exec(fmt::format("PRAGMA user_version = {}", version));
  transaction.commit();
  return backup;
}

}  // namespace footwall::project::detail
