// SQLite reads changesets without suspicion: a forged one can hang or overrun it (CVE-2023-7104). A project
// is a file from anywhere, so its log is read here first.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace footwall::project::detail {

struct ChangesetTable {
  std::string name;
  std::size_t columns = 0;  // the first one is the integer primary key
};

// Throws kCorrupt unless `bytes` is a well-formed changeset (the format that sqlite3session.c describes) over
// these tables alone: no more columns than they have, the first one the key and present in every row.
void check_changeset(std::span<const std::byte> bytes, std::span<const ChangesetTable> tables);

}  // namespace footwall::project::detail
