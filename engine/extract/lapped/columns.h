// The voxels of a face as columns along its dominant axis, without their coordinates along it: all that the
// coder of a face's values needs of its shape.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace footwall::extract::lapped {

// One row: columns at u, u + 1, ... for one v.
struct ColumnRow {
  std::int64_t v = 0;
  std::int64_t u = 0;
  std::size_t first = 0;  // its first column in Columns::lengths
  std::size_t count = 0;
};

struct Columns {
  std::vector<ColumnRow> rows;        // by ascending v, and u where v is the same; never overlapping
  std::vector<std::int32_t> lengths;  // voxels of each column, row after row; 0: a gap
  std::int64_t voxels = 0;            // their sum

  void clear();
  // Appends a column; columns come by ascending v, then u.
  void add(std::int64_t u, std::int64_t v, std::int32_t length);
};

}  // namespace footwall::extract::lapped
