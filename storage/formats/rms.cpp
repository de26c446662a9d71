#include "storage/formats/rms.h"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <iterator>
#include <optional>

#include "storage/base/error.h"
#include "storage/base/text.h"
#include "storage/formats/detail/letters.h"
#include "storage/formats/detail/stick_collector.h"
#include "storage/formats/z_unit.h"

namespace footwall::formats::rms {
namespace {

using detail::Field;
using detail::RowError;

constexpr double kEndMark = 999.0;

bool ends_line(const std::vector<Field>& fields) {
  if (fields.size() < 3) return false;
  return std::all_of(fields.begin(), fields.begin() + 3,
                     [](const Field& field) { return text::number(field.text) == kEndMark; });
}

bool starts_with_numbers(const std::vector<Field>& fields) {
  if (fields.size() < 3) return false;
  return std::all_of(fields.begin(), fields.begin() + 3,
                     [](const Field& field) { return text::number(field.text).has_value(); });
}

bool names_attribute(const std::vector<Field>& fields) {
  constexpr std::string_view kTypes[] = {"Discrete", "String", "Float", "Int"};
  return fields.size() >= 2 &&
         std::find(std::begin(kTypes), std::end(kTypes), fields[0].text) != std::end(kTypes);
}

bool has_line_ends(std::string_view text) {
  detail::Rows rows(text);
  std::vector<Field> fields;
  while (rows.next()) {
    if (rows.row().find("999") == std::string_view::npos) continue;
    detail::split_fields(rows.row(), 0, fields);
    if (ends_line(fields)) return true;
  }
  return false;
}

// "Fault_Name" -> "faultname"
std::string key_of(std::string_view name) {
  std::string key = detail::lower(name);
  std::erase_if(key, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
  return key;
}

class Reader {
 public:
  Reader(const SticksOptions& options, bool are_lines) : collector_(options), are_lines_(are_lines) {}

  void add_row(std::int64_t number, std::string_view row) {
    detail::split_fields(row, 0, fields_);
    if (fields_.empty()) return;
    if (detail::is_comment(row)) return collector_.skip();
    if (rows_ == 0 && names_attribute(fields_)) return attribute(row);
    ++rows_;
    if (ends_line(fields_)) {
      number_ += line_has_rows_ ? 1 : 0;
      line_has_rows_ = false;
      return;
    }
    line_has_rows_ = true;
    try {
      add(row);
    } catch (const RowError& error) {
      collector_.reject(number, error);
    }
    if (!are_lines_) ++number_;
  }

  SticksImport finish() {
    if (!are_lines_ && stick_at_ == 0 && collector_.read() > 0) {
      collector_.assume("no row of 999.0 999.0 999.0: the rows are points, each a stick of its own");
    }
    return collector_.finish("a point", "rows read: x y z, and 999.0 999.0 999.0 at the end of each line");
  }

 private:
  void attribute(std::string_view row) {
    collector_.skip();
    ++attributes_;
    const std::string_view name = text::trimmed(row.substr(fields_[0].at + fields_[0].text.size()));
    const std::string key = key_of(name);
    constexpr std::string_view kFault[] = {"fault", "faultname"};
    constexpr std::string_view kStick[] = {"stick", "stickid", "segment", "segmentid",
                                           "seg",   "segid",   "lineid",  "polyid"};
    const std::size_t place = 2 + attributes_;  // from 0
    if (name_at_ == 0 && std::find(std::begin(kFault), std::end(kFault), key) != std::end(kFault)) {
      name_at_ = place;
      collector_.assume(fmt::format("attribute '{}' is the fault's name", name));
    } else if (stick_at_ == 0 && std::find(std::begin(kStick), std::end(kStick), key) != std::end(kStick)) {
      stick_at_ = place;
      collector_.assume(fmt::format("attribute '{}' is the stick's number", name));
    }
  }

  void add(std::string_view row) {
    detail::Knot knot;
    const auto field = [&](std::size_t n, std::string_view what) {
      return detail::field_at(fields_, n, row, what);
    };
    knot.xy = {detail::number_of(field(0, "X coordinate"), "X coordinate"),
               detail::number_of(field(1, "Y coordinate"), "Y coordinate")};
    knot.z = detail::number_of(field(2, "z"), "z");
    if (name_at_ > 0) knot.name = field(name_at_, "fault name").text;
    if (knot.name == "UNDEF") knot.name = {};
    knot.stick =
        stick_at_ > 0 ? detail::integer_of(field(stick_at_, "stick number"), "stick number") : number_;
    collector_.add(knot);
  }

  detail::StickCollector collector_;
  bool are_lines_;
  std::vector<Field> fields_;
  std::size_t attributes_ = 0, name_at_ = 0, stick_at_ = 0;  // places from 0; 0: not there
  std::int64_t rows_ = 0;
  std::int64_t number_ = 1;
  bool line_has_rows_ = false;
};

}  // namespace

bool recognises(std::string_view head) {
  detail::Rows rows(head);
  std::vector<Field> fields;
  bool has_attributes = false, has_ends = false;
  std::size_t seen = 0, points = 0;
  while (rows.next()) {
    detail::split_fields(rows.row(), 0, fields);
    if (fields.empty() || detail::is_comment(rows.row())) continue;
    if (seen == 0 && names_attribute(fields)) {
      has_attributes = true;
      continue;
    }
    ++seen;
    if (!starts_with_numbers(fields) || (fields.size() > 3 && !has_attributes)) continue;
    ++points;
    has_ends = has_ends || ends_line(fields);
  }
  if (has_attributes) return points > 0;
  return has_ends && points * 4 >= seen * 3;  // the other rows will be rejected
}

SticksImport parse(std::string_view text, const SticksOptions& options) {
  return detail::read_rows(Reader(options, has_line_ends(text)), text);
}

std::string write(std::span<const Stick> sticks, const SticksWriteOptions& options,
                  std::vector<std::string>& /*renamed*/) {
  constexpr std::string_view kEndRow = "999.000000 999.000000 999.000000\n";
  const int decimals = std::max(6, z_decimals(options.vertical_unit));
  std::string out;
  for (const Stick& stick : sticks) {
    for (const survey::WorldPoint& point : stick.points) {
      const double z = options.z_positive_up ? -point.z : point.z;
      const std::string row = fmt::format("{:.6f} {:.6f} {:.{}f}\n", point.x, point.y, z, decimals);
      if (row.starts_with("999.000000 999.000000 999.000000")) {
        throw Error(
            ErrorCode::kInvalid,
            fmt::format("fault {} has a point at 999 999 999, which ends a line in this format", stick.fault),
            "export another format");
      }
      out += row;
    }
    if (!stick.points.empty()) out += kEndRow;
  }
  return out;
}

}  // namespace footwall::formats::rms
