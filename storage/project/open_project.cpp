// Creating, opening and closing: who may write, what the file must be, how it is journalled.
#include <unistd.h>

#include <fmt/format.h>

#include "storage/base/error.h"
#include "storage/base/log.h"
#include "storage/base/partial_file.h"
#include "storage/project/detail/clock.h"
#include "storage/project/file_system.h"
#include "storage/project/detail/project_state.h"
#include "storage/project/detail/schema.h"
#include "storage/project/detail/survey_table.h"

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

int newest(const OpenOptions& options) {
  return options.migrations.empty() ? detail::kSchemaVersion : options.migrations.back().to;
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
    // DELETE mode leaves one whole file that read-only media can hold. A reader in our way keeps the
    // write-ahead log; the next clean close tries again.
    if (lock && !lost) {
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
  auto state = std::make_unique<State>();
  state->path = resolved(path);
  detail::check_header(state->path, newest(options));
  state->file_system = options.file_system.value_or(detail::file_system_of(state->path));
  const bool read_only_medium = state->file_system == FileSystem::kReadOnly;

  // 1. The right to write.
  if (mode == OpenMode::kWrite) {
    if (read_only_medium || ::access(state->path.c_str(), W_OK) != 0) {
      throw Error(ErrorCode::kIo, fmt::format("{} cannot be written", path.string()),
                  "open it read-only, or copy it to where you may write");
    }
    state->lock = lock_for(state->file_system, state->path, options);
  } else if (read_only_medium && has_pending_log(state->path)) {
    throw Error(
        ErrorCode::kIo,
        fmt::format("{} was not closed cleanly and cannot be put right on read-only media", path.string()),
        "copy it, with its -wal or -journal file, to where you may write, and open it there");
  }

  // 2. The file, and the proof that it is what it should be.
  const Access access = state->lock ? Access::kWrite : read_only_medium ? Access::kImmutable : Access::kRead;
  state->database = std::make_unique<Database>(state->path, access);
  Database& database = *state->database;
  state->version = detail::verify(database, options.migrations);
  database.exec("PRAGMA foreign_keys = ON");

  // 3. An older schema.
  if (state->version < newest(options)) {
    if (!state->lock) {
      throw Error(ErrorCode::kUnsupported,
                  fmt::format("{} has schema version {}, this program reads {}", path.string(),
                              state->version, newest(options)),
                  "open it once for writing: it is brought up to date after a backup copy");
    }
    const auto backup = detail::migrate(database, state->version, options.migrations);
    state->notices.emplace_back(fmt::format("brought from schema version {} to {}; the old file is {}",
                                            state->version, newest(options), backup.string()));
    state->version = detail::verify(database, options.migrations);
  }

  // 4. The journal, and what happened on the way.
  if (state->file_system == FileSystem::kNetwork) {
    state->notices.emplace_back(kNetworkNotice);
  }
  if (state->lock) {
    const bool network = state->file_system == FileSystem::kNetwork;
    database.text(network ? "PRAGMA journal_mode = DELETE" : "PRAGMA journal_mode = WAL");
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

void Project::close() {
  state_->close();
}

}  // namespace footwall::project
