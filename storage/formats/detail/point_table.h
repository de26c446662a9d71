// Tables whose columns have fixed places: [name] x y z [stick] [node] ..., as several programs write sticks.
#pragma once
#include <cstddef>
#include <span>
#include <string_view>

#include "storage/formats/sticks.h"

namespace footwall::formats::detail {

struct PointTable {
  bool has_name = false;               // the first column
  char delimiter = 0;                  // 0 = runs of blanks and tabs
  bool parted_by_blank_lines = false;  // and by nothing else: one group is one stick
};

// The delimiter of rows of numbers: tab, semicolon or comma where most rows have it, else blanks.
char delimiter_of(std::span<const std::string_view> rows);
// How many numbers a row starts with, after `skipped` fields.
std::size_t leading_numbers(std::string_view row, char delimiter, std::size_t skipped = 0);

// Reads the table; the first row of numbers tells whether sticks are numbered. what, hint: as for
// StickCollector::finish.
SticksImport parse_point_table(std::string_view text, const PointTable& table, const SticksOptions& options,
                               std::string_view what, std::string_view hint);

}  // namespace footwall::formats::detail
