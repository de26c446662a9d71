// A small table in an HDF5 file: texts as attributes of the file, one dataset a column, a check over all of
// them. What the columns mean is the caller's business. Serial.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace footwall::volume {

// Values row by row; a row holds as many as the column's `inner` shape says.
using ColumnValues = std::variant<std::vector<std::int64_t>, std::vector<std::int32_t>,
                                  std::vector<std::uint8_t>, std::vector<double>>;

struct Column {
  std::string name;
  std::vector<std::int64_t> inner;  // the shape of one row: {} for a number, {3, 3} for a triangle
  ColumnValues values;              // on reading: its alternative says the type that is wanted
  bool own_rows = false;            // it may have another number of rows than the table
};

struct ColumnTable {
  std::map<std::string, std::string> texts;  // none empty; "check" is the file's own
  std::int64_t rows = 0;
  std::vector<Column> columns;  // every one with `rows` rows
};

// Writes under a temporary name and renames when whole; the columns in their order, with the attribute
// "check": hash64 of their bytes. Little-endian. Throws kIo.
void write_column_file(const ColumnTable& table, const std::filesystem::path& path);

// Reads the texts and columns that `wanted` names, with the types and shapes that it has; other columns are
// not looked at. No more is allocated than the file really holds. Throws kNotFound; kFormat (no HDF5 file, or
// one without these texts and columns); kCorrupt (the check differs).
ColumnTable read_column_file(const std::filesystem::path& path, const ColumnTable& wanted);

}  // namespace footwall::volume
