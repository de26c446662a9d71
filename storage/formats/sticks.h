// Fault sticks as plain values, and what an import of them has to tell its user.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "storage/survey/points.h"

namespace footwall::formats {

struct Stick {
  std::string fault;
  std::int64_t number = 0;  // as the file numbers it
  std::vector<survey::WorldPoint> points;
};

struct SticksOptions {
  bool z_positive_up = false;  // the file's z is elevation: its sign is turned
};

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

struct SticksImport {
  std::vector<Stick> sticks;
  ImportReport report;
};

}  // namespace footwall::formats
