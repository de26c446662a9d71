// The tables of a project file, and the proof that a file has these and nothing else.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "storage/base/job_context.h"
#include "storage/project/detail/database.h"
#include "storage/project/project.h"

namespace footwall::project::detail {

inline constexpr std::int32_t kApplicationId = 0x46574C31;  // "FWL1", at byte 68 of the file
inline constexpr int kSchemaVersion = 4;

// The steps from version 1 to kSchemaVersion, and behind them those of the caller.
std::vector<Migration> all_migrations(std::span<const Migration> further);

// The tables whose changes the undo log records.
std::span<const char* const> tables_under_undo();

// The first bytes alone, before SQLite sees the file: a SQLite database, with our application_id, as long as
// it says, and not newer than newest_version. Throws kNotFound, kFormat, kCorrupt, kUnsupported.
void check_header(const std::filesystem::path& path, int newest_version);

// Makes all tables of kSchemaVersion in an empty database.
void create_schema(Database& database);

// Throws kFormat or kCorrupt unless application_id, quick_check and every table, index, view and trigger are
// what version user_version has; kUnsupported for a newer version. Returns the version. migrations: all of
// them.
int verify(Database& database, std::span<const Migration> migrations);

// A copy of the database as of one moment, as a file that is closed cleanly; `to` is replaced. Cancel is
// looked at every few megabytes.
void back_up(Database& database, const std::filesystem::path& to, const JobContext& job);

// Lets this connection see an older file as the newest version has it, without changing it; false where some
// migration cannot be shown so.
bool show_as_newest(Database& database, int from, std::span<const Migration> migrations);

// Copies the file to a backup beside it, then runs the migrations after `from` in one transaction. Returns
// the backup's path.
std::filesystem::path migrate(Database& database, int from, std::span<const Migration> migrations);

}  // namespace footwall::project::detail
