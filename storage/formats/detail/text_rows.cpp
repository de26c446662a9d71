#include "storage/formats/detail/text_rows.h"

#include <fmt/format.h>
#include <algorithm>

#include <cmath>

#include "storage/base/text.h"

namespace footwall::formats::detail {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";
constexpr std::size_t kNone = std::string_view::npos;

Field trimmed(std::string_view row, std::size_t from, std::size_t to) {
  while (from < to && kBlanks.find(row[from]) != kNone) ++from;
  while (to > from && kBlanks.find(row[to - 1]) != kNone) --to;
  return {row.substr(from, to - from), from};
}

// Where the quoted text that starts at `at` closes, kNone where it does not.
std::size_t closing_quote(std::string_view row, std::size_t at) {
  if (row[at] != '"' && row[at] != '\'') return kNone;
  return row.find(row[at], at + 1);
}

std::string shown(std::string_view word) {
  return word.size() <= 40 ? std::string(word) : std::string(word.substr(0, 40)) + "...";
}

}  // namespace

Rows::Rows(std::string_view text) : left_(text) {
  if (left_.starts_with("\xEF\xBB\xBF")) left_.remove_prefix(3);
  if (left_.find('\n') == kNone && left_.find('\r') != kNone) end_ = '\r';
}

bool Rows::next() {
  if (left_.empty()) return false;
  const std::size_t end = left_.find(end_);
  row_ = left_.substr(0, end);
  left_.remove_prefix(end == kNone ? left_.size() : end + 1);
  if (row_.ends_with('\r')) row_.remove_suffix(1);
  ++number_;
  return true;
}

std::vector<std::string_view> first_rows(std::string_view head, std::size_t limit) {
  std::vector<std::string_view> found;
  for (Rows rows(head); found.size() < limit && rows.next();) {
    const std::string_view row = text::trimmed(rows.row());
    if (!row.empty() && !is_comment(row)) found.push_back(row);
  }
  return found;
}

void split_fields(std::string_view row, char delimiter, std::vector<Field>& fields) {
  fields.clear();
  std::size_t at = 0;
  while (true) {
    while (at < row.size() && row[at] != delimiter && kBlanks.find(row[at]) != kNone) ++at;
    if (at == row.size() && delimiter == 0) return;
    const std::size_t quote = at < row.size() ? closing_quote(row, at) : kNone;
    const std::size_t search = quote == kNone ? at : quote + 1;
    const std::size_t end = std::min(
        delimiter == 0 ? row.find_first_of(kBlanks, search) : row.find(delimiter, search), row.size());
    fields.push_back(quote == kNone ||
                             quote + 1 != trimmed(row, at, end).at + trimmed(row, at, end).text.size()
                         ? trimmed(row, at, end)
                         : trimmed(row, at + 1, quote));
    if (end == row.size() || fields.size() == kMostFields) return;
    at = end + 1;
  }
}

Field columns_of(std::string_view row, std::size_t first, std::size_t last) {
  const std::size_t from = std::min(first - 1, row.size());
  return trimmed(row, from, std::clamp(last, from, row.size()));
}

bool is_comment(std::string_view row) {
  row = text::trimmed(row);
  if (row.empty()) return false;
  if (row.front() == '#' || row.front() == '!' || row.starts_with("//")) return true;
  return row.starts_with("--") && !(row.size() > 2 && (row[2] == '.' || (row[2] >= '0' && row[2] <= '9')));
}

double number_of(const Field& field, std::string_view what) {
  const auto value = text::number(field.text);
  if (!value || !std::isfinite(*value)) {
    throw RowError{field.at, field.text.empty() ? fmt::format("the {} is missing", what)
                                                : fmt::format("'{}' is no {}", shown(field.text), what)};
  }
  if (std::fabs(*value) >= kNullFrom) throw RowError{field.at, fmt::format("the {} is a null value", what)};
  return *value;
}

std::int64_t integer_of(const Field& field, std::string_view what) {
  const double value = number_of(field, what);
  if (std::floor(value) != value || std::fabs(value) > 1e15) {
    throw RowError{field.at, fmt::format("'{}' is no {}", shown(field.text), what)};
  }
  return static_cast<std::int64_t>(value);
}

const Field& field_at(std::span<const Field> fields, std::size_t n, std::string_view row,
                      std::string_view what) {
  if (n >= fields.size()) throw RowError{row.size(), fmt::format("the row ends before the {}", what)};
  return fields[n];
}

}  // namespace footwall::formats::detail
