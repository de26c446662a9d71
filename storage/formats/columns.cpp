#include "storage/formats/columns.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <map>

#include <cctype>
#include <iterator>

#include "storage/base/error.h"
#include "storage/base/text.h"
#include "storage/formats/detail/letters.h"
#include "storage/formats/detail/point_table.h"
#include "storage/formats/detail/stick_collector.h"
#include "storage/formats/z_unit.h"

namespace footwall::formats::columns {
namespace {

using detail::Field;
using detail::RowError;

constexpr auto kMostColumns = static_cast<int>(detail::kMostFields);

struct Column {
  std::string_view name;
  int ColumnMap::*place;
  std::string_view headings;  // in lower case, each between blanks
};
constexpr std::array<Column, 8> kColumns{{
    {"name", &ColumnMap::name, " name fault fault_name faultname "},
    {"stick", &ColumnMap::stick, " stick stick_id stickid stick# segment seg poly_id polyid line_id "},
    {"node", &ColumnMap::node, " node node_id knot point_id "},
    {"x", &ColumnMap::x, " x x_utme x_coord xcoord easting east utmx "},
    {"y", &ColumnMap::y, " y y_utmn y_coord ycoord northing north utmy "},
    {"z", &ColumnMap::z, " z z_tvdss z_coord zcoord depth time twt tvdss "},
    {"inline", &ColumnMap::inline_number, " inline il iline inline_number "},
    {"crossline", &ColumnMap::crossline_number, " crossline xl xline crossline_number trace "},
}};

bool is_complete(const ColumnMap& map) {
  return map.z > 0 && ((map.x > 0 && map.y > 0) || (map.inline_number > 0 && map.crossline_number > 0));
}

std::string described(const ColumnMap& map) {
  std::string out;
  for (const Column& column : kColumns) {
    if (map.*column.place > 0) {
      out += fmt::format("{}{}={}", out.empty() ? "" : ",", column.name, map.*column.place);
    }
  }
  return out;
}

// What the headings name; columns they do not name, and those named twice, stay 0.
ColumnMap map_of_headings(std::string_view row, char delimiter) {
  ColumnMap map;
  std::vector<Field> fields;
  detail::split_fields(row, delimiter, fields);
  for (std::size_t n = 0; n < std::min<std::size_t>(fields.size(), kMostColumns); ++n) {
    const std::string heading = ' ' + detail::lower(fields[n].text) + ' ';
    for (const Column& column : kColumns) {
      if (column.headings.find(heading) == std::string_view::npos || heading == "  ") continue;
      int& place = map.*column.place;
      if (place == 0) place = static_cast<int>(n) + 1;
    }
  }
  return map;
}

// The first rows that are not blank; headings may look like comments.
std::vector<std::string_view> rows_of(std::string_view text, int header_rows) {
  std::vector<std::string_view> found;
  for (detail::Rows rows(text); found.size() < 50 && rows.next();) {
    const std::string_view row = text::trimmed(rows.row());
    if (rows.number() > header_rows && !row.empty()) found.push_back(row);
  }
  return found;
}

struct Headings {
  ColumnMap map;
  std::string_view row;
};

// The headings in the first row that is no comment.
std::optional<Headings> headings_of(std::string_view text) {
  const std::vector<std::string_view> rows = detail::first_rows(text);
  if (rows.size() < 2) return std::nullopt;
  const char delimiter = detail::delimiter_of(rows);
  Headings headings{map_of_headings(rows.front(), delimiter), rows.front()};
  headings.map.delimiter = delimiter;
  if (!is_complete(headings.map)) return std::nullopt;
  std::vector<Field> fields;
  detail::split_fields(rows[1], delimiter, fields);
  const auto z = static_cast<std::size_t>(headings.map.z);
  if (z > fields.size() || !text::number(fields[z - 1].text)) return std::nullopt;
  return headings;
}

class Table {
 public:
  Table(const ColumnMap& map, const SticksOptions& options) : map_(map), sticks_(options) {}

  void add_row(std::string_view row) {
    detail::split_fields(row, map_.delimiter, fields_);
    detail::Knot knot;
    if (map_.x > 0 && map_.y > 0) {
      const Field* x = present(map_.x);
      const Field* y = present(map_.y);
      const bool by_lines =
          x == nullptr && y == nullptr && map_.inline_number > 0 && map_.crossline_number > 0;
      if (!by_lines) knot.xy = {{number(row, map_.x, "X coordinate"), number(row, map_.y, "Y coordinate")}};
    }
    if (map_.inline_number > 0 && map_.crossline_number > 0 &&
        (!knot.xy || (present(map_.inline_number) != nullptr && present(map_.crossline_number) != nullptr))) {
      knot.lines = {{number(row, map_.inline_number, "inline number"),
                     number(row, map_.crossline_number, "crossline number")}};
    }
    knot.z = number(row, map_.z, "z");
    if (map_.name > 0) {
      if (const Field* name = present(map_.name)) knot.name = name->text;
    }
    if (map_.stick > 0) {
      knot.stick = detail::integer_of(at(row, map_.stick, "stick number"), "stick number");
    } else if (map_.node > 0) {
      const std::int64_t node = detail::integer_of(at(row, map_.node, "node number"), "node number");
      if (last_node_ && node <= *last_node_) sticks_.end_stick();
      last_node_ = node;
    }
    sticks_.add(knot);
  }
  detail::StickCollector& sticks() { return sticks_; }

 private:
  const Field* present(int column) const {
    const auto n = static_cast<std::size_t>(column);
    return n <= fields_.size() && !fields_[n - 1].text.empty() ? &fields_[n - 1] : nullptr;
  }
  const Field& at(std::string_view row, int column, std::string_view what) const {
    return detail::field_at(fields_, static_cast<std::size_t>(column) - 1, row, what);
  }
  double number(std::string_view row, int column, std::string_view what) const {
    return detail::number_of(at(row, column, what), what);
  }

  ColumnMap map_;
  detail::StickCollector sticks_;
  std::vector<Field> fields_;
  std::optional<std::int64_t> last_node_;
};

}  // namespace

ColumnMap map_from(std::string_view text) {
  const auto refuse = [](const std::string& why) {
    throw Error(ErrorCode::kUsage, why,
                "columns are given as name=6,x=3,y=4,z=5,stick=7 (also node, inline, crossline), from 1");
  };
  ColumnMap map;
  for (const std::string_view part : text::split(text, ',')) {
    const std::size_t equals = part.find('=');
    const std::string_view name = text::trimmed(part.substr(0, equals));
    const auto found =
        std::find_if(kColumns.begin(), kColumns.end(), [&](const Column& c) { return c.name == name; });
    if (found == kColumns.end()) refuse(fmt::format("there is no column '{}'", name));
    const auto place = equals == std::string_view::npos
                           ? std::nullopt
                           : text::integer(text::trimmed(part.substr(equals + 1)));
    if (!place || *place < 1 || *place > kMostColumns) {
      refuse(fmt::format("'{}' does not give a column from 1 to {}", part, kMostColumns));
    }
    if (map.*found->place != 0) refuse(fmt::format("the column '{}' is given twice", name));
    map.*found->place = static_cast<int>(*place);
  }
  if (!is_complete(map)) refuse("z and either x and y, or inline and crossline, are needed");
  return map;
}

char delimiter_from(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, char>, 4> kNames{
      {{"comma", ','}, {"semicolon", ';'}, {"tab", '\t'}, {"blank", ' '}}};
  for (const auto& [word, delimiter] : kNames) {
    if (name == word) return delimiter;
  }
  const bool plain = name.size() == 1 && std::isprint(static_cast<unsigned char>(name[0])) != 0 &&
                     std::isalnum(static_cast<unsigned char>(name[0])) == 0;
  if (!plain) {
    throw Error(ErrorCode::kUsage, fmt::format("'{}' is no delimiter", name),
                "comma, semicolon, tab, blank, or one character that is no letter or digit");
  }
  return name[0];
}

bool recognises(std::string_view head) {
  return headings_of(head).has_value();
}

SticksImport parse(std::string_view text, const SticksOptions& options) {
  const auto headings = options.columns ? std::nullopt : headings_of(text);
  if (!options.columns && !headings) {
    throw Error(ErrorCode::kUsage, "the table does not name its columns",
                "--columns name=1,x=2,y=3,z=4,stick=5 does, with --header-rows and --delimiter where needed");
  }
  ColumnMap map = options.columns ? *options.columns : headings->map;
  if (!is_complete(map)) {
    throw Error(ErrorCode::kUsage, "columns of z and either X and Y, or inline and crossline, are needed");
  }
  if (options.columns && map.delimiter == 0)
    map.delimiter = detail::delimiter_of(rows_of(text, map.header_rows));
  if (map.delimiter == ' ') map.delimiter = 0;  // runs of blanks, for split_fields()

  Table table(map, options);
  detail::StickCollector& sticks = table.sticks();
  if (headings) sticks.assume("columns by their headings: " + described(map));
  bool below_headings = !headings;
  for (detail::Rows rows(text); rows.next();) {
    const std::string_view row = rows.row();
    const std::string_view content = text::trimmed(row);
    if (rows.number() <= map.header_rows) {
      sticks.skip();
    } else if (content.empty()) {
      sticks.end_stick();
    } else if (detail::is_comment(content) || !below_headings) {
      below_headings = below_headings || content == headings->row;
      sticks.skip();
    } else {
      try {
        table.add_row(row);
      } catch (const RowError& why) {
        sticks.reject(rows.number(), why);
      }
    }
  }
  return sticks.finish(
      "a point of a fault stick",
      "columns read: " + described(map) + "; --columns, --header-rows and --delimiter say otherwise");
}

std::string write(std::span<const Stick> sticks, const SticksWriteOptions& options,
                  std::vector<std::string>& renamed) {
  const bool with_lines = options.survey.has_value();
  std::string out = with_lines ? "name,stick,node,x,y,z,inline,crossline\n" : "name,stick,node,x,y,z\n";
  std::map<std::string_view, std::int64_t> count;
  const int decimals = z_decimals(options.vertical_unit);
  for (const Stick& stick : sticks) {
    const std::int64_t number = ++count[stick.fault];
    const std::string name = detail::written_name(stick.fault, "\"", false, renamed);
    std::int64_t node = 0;
    for (const survey::WorldPoint& point : stick.points) {
      fmt::format_to(std::back_inserter(out), "\"{}\",{},{},{:.4f},{:.4f},{:.{}f}", name, number, ++node,
                     point.x, point.y, detail::written_z(point.z, options), decimals);
      if (with_lines) {
        const auto [inline_number, crossline_number] = detail::nearest_lines(point, options);
        fmt::format_to(std::back_inserter(out), ",{},{}", inline_number, crossline_number);
      }
      out += '\n';
    }
  }
  return out;
}

}  // namespace footwall::formats::columns
