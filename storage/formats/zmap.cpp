#include "storage/formats/zmap.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <optional>

#include "storage/base/error.h"
#include "storage/base/text.h"
#include "storage/formats/detail/stick_collector.h"
#include "storage/formats/z_unit.h"

namespace footwall::formats::zmap {
namespace {

using detail::Field;
using detail::RowError;

constexpr std::string_view kAxis = "! z axis: positive ";  // of a comment that the writer makes
constexpr std::size_t kMostFields = 1000;

enum Role : std::size_t { kX, kY, kZ, kSegment, kRoles };
constexpr std::array<std::string_view, kRoles> kRoleNames{"X coordinate", "Y coordinate", "z",
                                                          "segment number"};

struct Column {
  std::size_t place = 0;            // among the fields, from 0
  std::size_t first = 0, last = 0;  // columns from 1; 0: not stated
  std::optional<double> null;
};

std::string upper(std::string_view word) {
  std::string out;
  for (const char c : word) out.push_back(static_cast<char>(std::toupper(static_cast<unsigned char>(c))));
  return out;
}

std::optional<Role> role_of(std::string_view field_name) {
  const std::string name = upper(field_name);
  const std::string first = name.substr(0, name.find_first_of(" (_"));
  if (first == "X" || first == "EASTING") return kX;
  if (first == "Y" || first == "NORTHING") return kY;
  if (first == "Z" || first == "DEPTH" || first == "TIME") return kZ;
  if (first == "SEG" || first == "SEGMENT" || first == "SEGID") return kSegment;
  return std::nullopt;
}

class Reader {
 public:
  explicit Reader(const SticksOptions& options) : collector_(options) {}

  void add_row(std::int64_t number, std::string_view row) {
    const std::string_view content = text::trimmed(row);
    if (content.empty()) return;
    if (content.front() == '!') return comment(content);
    if (content.front() == '@') return border(number, content);
    if (part_ == Part::kBefore) return collector_.skip();
    if (part_ == Part::kFields) return field(content);
    try {
      add(row);
    } catch (const RowError& error) {
      collector_.reject(number, error);
    }
  }

  SticksImport finish() {
    return collector_.finish("a point of a line",
                             "read are: '@... FREE POINT', a row a field, '@', and rows");
  }

 private:
  enum class Part : std::uint8_t { kBefore, kFields, kRows };

  void comment(std::string_view content) {
    collector_.skip();
    if (!content.starts_with(kAxis)) return;
    const auto words = text::words(content.substr(kAxis.size()));
    if (words.size() < 3 || (words[0] != "up," && words[0] != "down,")) return;
    const auto unit = z_unit_from(words[2]);
    collector_.file_states(words[0] == "up,", unit.value_or(""));
  }

  void border(std::int64_t number, std::string_view content) {
    if (part_ == Part::kBefore) {
      const auto parts = text::split(content.substr(1), ',');
      if (parts.size() > 1 && upper(parts[1]) == "GRID") {
        throw Error(ErrorCode::kFormat,
                    fmt::format("line {}: the file is a ZMAP+ grid ('{}'), not lines", number, parts[0]),
                    "export the fault's lines (a file with @FREE POINT)");
      }
      part_ = Part::kFields;
    } else if (part_ == Part::kFields) {
      part_ = Part::kRows;
      for (const Role role : {kX, kY, kZ}) {
        if (!columns_[role]) {
          throw Error(ErrorCode::kFormat,
                      fmt::format("line {}: the fields named have no {}", number, kRoleNames[role]),
                      "fields known: X, Y, Z, SEG I.D.");
        }
      }
      if (!columns_[kSegment]) {
        collector_.assume("no field SEG I.D.: the rows are points, each a stick of its own");
      }
    }
  }

  // name, place, type, ?, first column, last column, ?, null value ...
  void field(std::string_view content) {
    const auto parts = text::split(content, ',');
    const auto role = role_of(parts[0]);
    const std::size_t place = fields_named_++;
    if (!role || columns_[*role] || place > kMostFields) return;
    Column column;
    column.place = place;
    const auto whole = [&](std::size_t n) -> std::size_t {
      const auto value = n < parts.size() ? text::integer(parts[n]) : std::nullopt;
      return value && *value > 0 && *value < 100000 ? static_cast<std::size_t>(*value) : 0;
    };
    column.first = whole(4);
    column.last = whole(5);
    if (column.last < column.first) column.first = 0;
    for (std::size_t n = 6; n < 8 && n < parts.size() && !column.null; ++n) {
      column.null = text::number(parts[n]);
    }
    columns_[*role] = column;
  }

  Field value_at(const Column& column, std::string_view row, std::string_view what) const {
    if (!by_columns_) return detail::field_at(fields_, column.place, row, what);
    return detail::columns_of(row, column.first, column.last);
  }

  double value(Role role, std::string_view row) const {
    const Field at = value_at(*columns_[role], row, kRoleNames[role]);
    const double number = detail::number_of(at, kRoleNames[role]);
    if (columns_[role]->null == number) {
      throw RowError{at.at, fmt::format("the {} is the file's null value", kRoleNames[role])};
    }
    return number;
  }

  // The first row tells whether the columns stated are those that the rows have.
  void choose(std::string_view row) {
    chosen_ = true;
    by_columns_ = true;
    for (const auto& column : columns_) {
      if (!column) continue;
      const bool fits = column->first > 0 &&
                        text::number(detail::columns_of(row, column->first, column->last).text).has_value();
      by_columns_ = by_columns_ && fits;
    }
    if (!by_columns_) {
      collector_.assume(
          "the columns that the header states do not fit the first row: rows are split at blanks");
    }
  }

  void add(std::string_view row) {
    if (!chosen_) choose(row);
    detail::split_fields(row, 0, fields_);
    detail::Knot knot;
    knot.xy = {value(kX, row), value(kY, row)};
    knot.z = value(kZ, row);
    knot.stick = columns_[kSegment]
                     ? detail::integer_of(value_at(*columns_[kSegment], row, kRoleNames[kSegment]),
                                          kRoleNames[kSegment])
                     : ++points_;
    collector_.add(knot);
  }

  detail::StickCollector collector_;
  Part part_ = Part::kBefore;
  std::array<std::optional<Column>, kRoles> columns_;
  std::size_t fields_named_ = 0;
  std::vector<Field> fields_;
  bool chosen_ = false, by_columns_ = false;
  std::int64_t points_ = 0;
};

}  // namespace

bool recognises(std::string_view head) {
  detail::Rows rows(head);
  while (rows.next()) {
    const std::string_view row = text::trimmed(rows.row());
    if (row.starts_with('@')) return upper(row).find("FREE POINT") != std::string::npos;
  }
  return false;
}

SticksImport parse(std::string_view text, const SticksOptions& options) {
  return detail::read_rows(Reader(options), text);
}

std::string write(std::span<const Stick> sticks, const SticksWriteOptions& options,
                  std::vector<std::string>& /*renamed*/) {
  std::string out =
      fmt::format("!\n! Lines of a fault; X and Y in {}\n{}{}, unit {}\n!\n", options.horizontal_unit, kAxis,
                  options.z_positive_up ? "up" : "down", options.vertical_unit);
  out += "@FREE POINT        , DATA, 80, 1\n";
  constexpr std::array<std::string_view, kRoles> kNames{"X (EASTING)", "Y (NORTHING)", "Z VALUE", "SEG I.D."};
  constexpr std::array<int, kRoles> kTypes{1, 2, 3, 35};
  const int z_digits = std::max(6, z_decimals(options.vertical_unit));
  for (std::size_t n = 0; n < kRoles; ++n) {
    const std::size_t first = 20 * n + 1;
    fmt::format_to(std::back_inserter(out), "{:<19}, {}, {}, 1, {}, {},, 1.0E+30,,, {}, 0\n", kNames[n],
                   n + 1, kTypes[n], first, n == kSegment ? first + 9 : first + 19,
                   n == kSegment ? 0
                   : n == kZ     ? z_digits
                                 : 6);
  }
  out += "@\n";
  std::int64_t number = 0;
  for (const Stick& stick : sticks) {
    for (const survey::WorldPoint& point : stick.points) {
      const std::string row = fmt::format("{:20.6f}{:20.6f}{:20.{}f}{:10}\n", point.x, point.y,
                                          options.z_positive_up ? -point.z : point.z, z_digits, number);
      if (row.size() != 71) {
        throw Error(
            ErrorCode::kInvalid,
            fmt::format("fault {} has a point whose coordinates exceed the format's 20 columns: {} {} {}",
                        stick.fault, point.x, point.y, point.z),
            "export another format");
      }
      out += row;
    }
    ++number;
  }
  return out;
}

}  // namespace footwall::formats::zmap
