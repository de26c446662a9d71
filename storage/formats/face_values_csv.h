// A table of one number for each face, as a script or a spreadsheet writes it.
#pragma once
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

namespace footwall::formats::face_values_csv {

struct FaceValue {
  std::int64_t line = 0;  // of the file, from 1
  std::string fault;      // empty where the table has no such column
  std::string face;       // as `footwall faces` names it
  double value = 0;       // NaN: undefined
};

// Columns by the first row's names: `face`, optionally `fault`, and the numbers under `value` or under
// `name`; further columns are passed over, so that a table of `footwall faces` with one more column will do.
// An empty cell and "nan" are undefined. Cells may stand in quotation marks (RFC 4180, without line ends in
// them). Throws kFormat for a first row without these columns, kInvalid naming the line of a row that cannot
// be used: too few cells, no face, no finite number.
std::vector<FaceValue> read(std::istream& in, const std::string& name);

}  // namespace footwall::formats::face_values_csv
