// Creating, opening and closing: who may write, what the file must be, how it is journalled.
#include <unistd.h>

#include <fmt/format.h>
#include <fstream>

#include "storage/base/error.h"
#include "storage/base/log.h"
#include "storage/base/partial_file.h"
#include "storage/project/detail/clock.h"
#include "storage/project/detail/project_state.h"
#include "storage/project/detail/schema.h"
#include "storage/project/detail/survey_table.h"
#include "storage/project/file_system.h"

namespace footwall::project {
namespace {

using detail::Access;
using detail::Database;

constexpr std::string_view kNetworkNotice =
    "the project lies on a network file system: edits are slower, and a lease keeps other writers out";

std::filesystem::path resolved(const std::filesystem::path& path) {
  // Through symbolic links, so that everybody meets at the same lock.
  std::error_code trouble;
  auto whole = std::filesystem::weakly_canonical(std::filesystem::absolute(path), trouble);
  return trouble ? std::filesystem::absolute(path) : whole;
}

// Pending changes that only a writer of the folder can bring in.
bool has_pending_log(const std::filesystem::path& path) {
  for (const char* suffix : {"-wal", "-journal"}) {
    std::error_code trouble;
    const auto size = std::filesystem::file_size(path.string() + suffix, trouble);
    if (!trouble && size > 0) return true;
  }
  return false;
}

// Byte 18 of the file: 2 is written through a log.
bool is_written_through_a_log(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  char head[19] = {};
  return file.read(head, sizeof head) && head[18] == 2;
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

// How a reader opens the file. Immutable means without any lock: right only where nobody can be writing.
Access access_for_reading(FileSystem kind, const std::filesystem::path& path) {
  const bool log = is_written_through_a_log(path);
  const bool pending = has_pending_log(path);
  if (kind == FileSystem::kReadOnly) {
    if (!pending) return Access::kImmutable;
    throw Error(
        ErrorCode::kIo,
        fmt::format("{} was not closed cleanly and cannot be put right on read-only media", path.string()),
        "copy it, with its -wal or -journal file, to where you may write, and open it there");
  }
  const auto lock_file = detail::lock_path(path);
  if (kind == FileSystem::kNetwork && log && std::filesystem::exists(lock_file)) {
    const detail::Holder holder = detail::holder_of(lock_file);
    if (holder.machine != detail::Holder::myself("").machine) {
      throw Error(ErrorCode::kHeld,
                  fmt::format("{} is held by {}, which writes through a log that only its own host can read",
                              path.string(), holder.in_words()),
                  "open it when it is closed there");
    }
  }
  // A log needs a file beside the project. Who may not make it can still read what was closed.
  const bool may_write = ::access(folder_of(path).c_str(), W_OK) == 0;
  if (log && !pending && !may_write && !std::filesystem::exists(lock_file)) return Access::kImmutable;
  return Access::kRead;
}

// Who writes at present, for a reader's notice; empty where nobody does, or nobody who lives.
std::string writer_in_words(const std::filesystem::path& path) {
  const auto lock_file = detail::lock_path(path);
  const detail::Holder holder = detail::holder_of(lock_file);
  if (holder.token.empty() || holder.dead()) return {};
  return fmt::format("{} holds the project for writing; this is what is there now", holder.in_words());
}

std::unique_ptr<detail::WriterLock> lock_for(FileSystem kind, const std::filesystem::path& path,
                                             const OpenOptions& options) {
  return kind == FileSystem::kNetwork ? detail::lease(path, options.edit_socket)
                                      : detail::lock_locally(path, options.edit_socket);
}

}  // namespace

Project::State::~State() {
  try {
    close();
  } catch (const Error& error) {
    log::error(error.what());
  }
}

void Project::State::close() {
  if (database) {
    try {
      if (lock && !lost) lock->check();
    } catch (const Error& error) {
      lost = true;  // whoever has it now decides about the journal
      log::warn(error.what());
    }
    // DELETE mode leaves one whole file that read-only media can hold. A reader in our way keeps the
    // write-ahead log; the next clean close tries again.
    const bool last = lock.use_count() == 1;  // those beside this one would only be in its way
    if (lock && !lost && last) {
      try {
        database->exec(
            "PRAGMA busy_timeout = 0; PRAGMA wal_checkpoint(TRUNCATE); PRAGMA journal_mode = DELETE");
      } catch (const Error& error) {
        if (error.code() != ErrorCode::kHeld) {
          database.reset();
          lock.reset();
          throw;
        }
      }
    }
    database.reset();
  }
  lock.reset();
}

void Project::State::require_writer() {
  if (!database) throw Error(ErrorCode::kInvalid, fmt::format("{} is closed", path.string()));
  if (!lock) {
    throw Error(ErrorCode::kInvalid, fmt::format("{} is open read-only", path.string()),
                "open it for writing");
  }
  require(!editing, "a project was written to from within edit()");
  require_lock();
}

void Project::State::require_lock() {
  if (lost) {
    throw Error(ErrorCode::kHeld, fmt::format("{} is read-only since its lock was lost", path.string()),
                "close it and open it again");
  }
  try {
    lock->check();
  } catch (const Error&) {
    lost = true;
    throw;
  }
}

Project::Project(std::unique_ptr<State> state) : state_(std::move(state)) {}
Project::Project(Project&&) noexcept = default;
Project& Project::operator=(Project&&) noexcept = default;
Project::~Project() = default;

Project Project::create(const std::filesystem::path& path, const std::optional<survey::Geometry>& survey,
                        const OpenOptions& options) {
  const auto whole = resolved(path);
  const Error exists(ErrorCode::kInvalid, fmt::format("{} already exists", path.string()),
                     "choose another name, or remove it first");
  if (std::filesystem::exists(whole)) throw exists;
  if (survey) survey->validate();
  {
    // Made whole under another name: a crash leaves no half project, and nobody can open one.
    PartialFile file(whole);
    {
      Database database(file.path(), Access::kCreate);
      // Four times the default: meshes and statistics are blobs of megabytes, read page by page.
      database.exec("PRAGMA page_size = 16384");
      detail::Transaction transaction(database);
      detail::create_schema(database);
      if (survey) detail::SurveyTable(database).write(*survey, "{}");
      transaction.commit();
      database.close();
    }
    if (std::filesystem::exists(whole)) throw exists;
    file.commit();
  }
  return open(whole, OpenMode::kWrite, options);
}

Project Project::open(const std::filesystem::path& path, OpenMode mode, const OpenOptions& options) {
  const std::vector<Migration> migrations = detail::all_migrations(options.migrations);
  const int newest = migrations.back().to;
  auto state = std::make_unique<State>();
  state->path = resolved(path);
  state->migrations = migrations;
  detail::check_header(state->path, newest);
  state->file_system =
      options.file_system ? *options.file_system : file_system_at(folder_of(state->path)).kind;
  const bool read_only_medium = state->file_system == FileSystem::kReadOnly;

  // 1. The right to write.
  if (mode == OpenMode::kWrite) {
    if (read_only_medium || ::access(state->path.c_str(), W_OK) != 0) {
      throw Error(ErrorCode::kIo, fmt::format("{} cannot be written", path.string()),
                  "open it read-only, or copy it to where you may write");
    }
    state->lock = lock_for(state->file_system, state->path, options);
  }

  // 2. The file, and the proof that it is what it should be.
  state->access = state->lock ? Access::kWrite : access_for_reading(state->file_system, state->path);
  state->database = std::make_unique<Database>(state->path, state->access);
  Database& database = *state->database;
  state->version = detail::verify(database, migrations);
  database.exec("PRAGMA foreign_keys = ON");

  // 3. An older schema.
  if (state->version < newest && !state->lock) {
    if (!detail::show_as_newest(database, state->version, migrations)) {
      throw Error(ErrorCode::kUnsupported,
                  fmt::format("{} has schema version {}, this program reads {}", path.string(),
                              state->version, newest),
                  "any command that changes it (footwall edit PROJECT < /dev/null will do) brings it up to "
                  "date, after a backup copy beside it");
    }
  } else if (state->version < newest) {
    const auto backup = detail::migrate(database, state->version, migrations);
    state->notices.emplace_back(fmt::format("brought from schema version {} to {}; the old file is {}",
                                            state->version, newest, backup.string()));
    state->version = detail::verify(database, migrations);
  }

  // 4. The journal, and what happened on the way.
  if (state->file_system == FileSystem::kNetwork) {
    state->notices.emplace_back(kNetworkNotice);
  }
  if (!state->lock) {
    if (auto writer = writer_in_words(state->path); !writer.empty())
      state->notices.push_back(std::move(writer));
  } else {
    const bool network = state->file_system == FileSystem::kNetwork;
    const std::string journal =
        database.text(network ? "PRAGMA journal_mode = DELETE" : "PRAGMA journal_mode = WAL");
    if (network && journal != "delete") {
      throw Error(ErrorCode::kHeld,
                  fmt::format("{} is still written through a log that a network file system cannot carry",
                              state->path.string()),
                  "close it wherever it is open, and try again");
    }
    if (!state->lock->taken_over().empty()) {
      state->notices.push_back(state->lock->taken_over());
      state->write([&] {
        detail::Query(database, "INSERT INTO event(made, what) VALUES(?, ?)", detail::now_text(),
                      state->lock->taken_over())
            .run();
      });
    }
  }
  return Project(std::move(state));
}

Project Project::beside() const {
  if (!state_->database) throw Error(ErrorCode::kInvalid, fmt::format("{} is closed", state_->path.string()));
  auto state = std::make_unique<State>();
  state->path = state_->path;
  state->file_system = state_->file_system;
  state->access = state_->access;
  state->lock = state_->lock;
  state->turn = state_->turn;
  state->lost = state_->lost;
  state->version = state_->version;
  state->migrations = state_->migrations;
  state->regenerator = state_->regenerator;
  state->database = std::make_unique<Database>(state->path, state->access);
  state->database->exec("PRAGMA foreign_keys = ON");
  if (!state->lock) detail::show_as_newest(*state->database, state->version, state->migrations);
  return Project(std::move(state));
}

std::string edit_socket_of(const std::filesystem::path& project) {
  const detail::Holder holder = detail::holder_of(detail::lock_path(resolved(project)));
  return holder.dead() ? std::string() : holder.edit_socket;
}

void Project::close() {
  state_->close();
}

void Project::copy_database(const std::filesystem::path& copy, const JobContext& job) const {
  if (std::filesystem::exists(copy)) {
    throw Error(ErrorCode::kInvalid, fmt::format("{} already exists", copy.string()), "choose another name");
  }
  detail::back_up(*state_->database, copy, job);
}

}  // namespace footwall::project
