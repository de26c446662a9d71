// What an import has to tell its user, whatever the format.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace footwall::formats {

struct RejectedRow {
  std::int64_t line = 0;    // from 1
  std::int64_t column = 0;  // of the offending word, from 1
  std::string reason;
};

struct ImportReport {
  std::int64_t read = 0;            // rows that became points
  std::int64_t skipped = 0;         // comments, header rows, repeated points
  std::int64_t rejected_count = 0;  // all of them; `rejected` lists the first kListedRejects
  std::vector<RejectedRow> rejected;
  std::vector<std::string> assumed;
  std::vector<std::string> renamed;  // "old -> new", for names that had to be changed
  static constexpr std::size_t kListedRejects = 1000;
};

}  // namespace footwall::formats
