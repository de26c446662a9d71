// Rows and fields of text files, for readers that say exactly where a row is wrong.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace footwall::formats::detail {

// Thrown while one row is read and caught by the loop over the rows, which goes on with the next.
struct RowError {
  std::size_t at;  // bytes from the row's start
  std::string reason;
};

// The rows of a text without their ends: LF, CR LF, or CR alone in a text that has no LF. A byte order mark
// (UTF-8) is left out. No row is copied.
class Rows {
 public:
  explicit Rows(std::string_view text);
  // Steps to the next row (first: to the first); false at the end.
  bool next();
  std::string_view row() const { return row_; }
  std::int64_t number() const { return number_; }  // from 1

 private:
  std::string_view left_;
  std::string_view row_;
  std::int64_t number_ = 0;
  char end_ = '\n';
};

// What a reader with add_row(number, row) and finish() makes of a text.
template <class Reader>
auto read_rows(Reader reader, std::string_view text) {
  for (Rows rows(text); rows.next();) reader.add_row(rows.number(), rows.row());
  return reader.finish();
}

// The first `limit` rows that are neither blank nor comments, trimmed: what recognisers look at.
std::vector<std::string_view> first_rows(std::string_view head, std::size_t limit = 50);

// True where three of four rows pass: a recogniser does not stumble over the bad rows that a reader rejects.
template <class Test>
bool mostly(std::span<const std::string_view> rows, Test test) {
  return !rows.empty() && std::count_if(rows.begin(), rows.end(), test) * 4 >= std::ssize(rows) * 3;
}

struct Field {
  std::string_view text;  // trimmed, without quotes
  std::size_t at = 0;     // bytes from the row's start
};

// Fields between delimiters, or between runs of blanks and tabs where delimiter is 0. What stands in "..." or
// '...' is one field, whatever it holds. The vector is used again from row to row; it gets the first
// kMostFields.
constexpr std::size_t kMostFields = 1000;
void split_fields(std::string_view row, char delimiter, std::vector<Field>& fields);
// Columns first..last, from 1, both within, as the row has them (a shorter row gives a shorter field).
Field columns_of(std::string_view row, std::size_t first, std::size_t last);

// "#", "!", "//" or "--" (not "--5"), after blanks.
bool is_comment(std::string_view row);

// A finite number; 1e29 and above stand for "no value". Throws RowError naming `what`.
double number_of(const Field& field, std::string_view what);
// The same for whole numbers, also written as 7.0, below 1e15.
std::int64_t integer_of(const Field& field, std::string_view what);
// Field n, from 0. Throws RowError at the row's end where the row has fewer.
const Field& field_at(std::span<const Field> fields, std::size_t n, std::string_view row,
                      std::string_view what);

// Headings are looked for no further down.
constexpr std::int64_t kMostHeaderRows = 1000;
constexpr double kNullFrom = 1e29;

}  // namespace footwall::formats::detail
