#include "storage/formats/face_values_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <limits>

#include "storage/base/error.h"
#include "storage/base/text.h"

namespace footwall::formats::face_values_csv {
namespace {

constexpr std::size_t kLongestLine = std::size_t{1} << 20;

Error wrong(std::int64_t line, const std::string& why) {
  return {ErrorCode::kInvalid, fmt::format("line {}: {}", line, why)};
}

// A cell in quotation marks from `at` on, which is moved behind it.
std::string quoted_cell(std::string_view row, std::size_t& at, std::int64_t line) {
  std::string cell;
  for (++at; at < row.size(); ++at) {
    if (row[at] != '"') {
      cell.push_back(row[at]);
    } else if (at + 1 < row.size() && row[at + 1] == '"') {
      cell.push_back(row[++at]);
    } else {
      ++at;
      return cell;
    }
  }
  throw wrong(line, "a quotation mark is not closed");
}

void split(std::string_view row, std::int64_t line, std::vector<std::string>& cells) {
  cells.clear();
  std::size_t at = 0;
  while (true) {
    std::string cell;
    if (at < row.size() && row[at] == '"') cell = quoted_cell(row, at, line);
    const std::size_t end = std::min(row.find(',', at), row.size());
    cells.push_back(cell + std::string(text::trimmed(row.substr(at, end - at))));
    if (end == row.size()) return;
    at = end + 1;
  }
}

bool next_row(std::istream& in, std::int64_t& line, std::string& row) {
  while (std::getline(in, row)) {
    ++line;
    if (row.size() > kLongestLine) throw wrong(line, "longer than a table's row can be");
    if (!row.empty() && row.back() == '\r') row.pop_back();
    if (line == 1 && row.starts_with("\xEF\xBB\xBF")) row.erase(0, 3);
    if (!text::trimmed(row).empty()) return true;
  }
  return false;
}

double value_of(const std::string& cell, std::int64_t line) {
  constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();
  if (cell.empty() || cell == "nan" || cell == "NaN" || cell == "NAN") return kUndefined;
  const auto number = text::number(cell);
  if (!number || !std::isfinite(*number)) throw wrong(line, fmt::format("'{}' is not a finite number", cell));
  return *number;
}

}  // namespace

std::vector<FaceValue> read(std::istream& in, const std::string& name) {
  std::int64_t line = 0;
  std::string row;
  std::vector<std::string> cells;
  if (next_row(in, line, row)) split(row, line, cells);
  const auto column = [&](const std::string& title) {
    const auto found = std::find(cells.begin(), cells.end(), title);
    return found == cells.end() ? std::string::npos : static_cast<std::size_t>(found - cells.begin());
  };
  const std::size_t face = column("face");
  const std::size_t fault = column("fault");
  const std::size_t value = column(name) != std::string::npos ? column(name) : column("value");
  if (face == std::string::npos || value == std::string::npos) {
    throw Error(ErrorCode::kFormat, "the first row does not name the columns",
                fmt::format("begin with 'face,value' or 'fault,face,value' ('{}' will do for value)", name));
  }
  const std::size_t least = std::max({face, value, fault == std::string::npos ? 0 : fault}) + 1;
  std::vector<FaceValue> values;
  while (next_row(in, line, row)) {
    split(row, line, cells);
    if (cells.size() < least) throw wrong(line, fmt::format("{} cells, expected {}", cells.size(), least));
    if (cells[face].empty()) throw wrong(line, "no face");
    values.push_back(
        {line, fault == std::string::npos ? "" : cells[fault], cells[face], value_of(cells[value], line)});
  }
  if (in.bad()) throw Error(ErrorCode::kIo, "the table could not be read to its end");
  return values;
}

}  // namespace footwall::formats::face_values_csv
