#include "storage/formats/cps3.h"

#include <fmt/format.h>
#include <iterator>
#include <map>
#include <optional>

#include "storage/base/error.h"
#include "storage/base/text.h"
#include "storage/formats/detail/stick_collector.h"
#include "storage/formats/z_unit.h"

namespace footwall::formats::cps3 {
namespace {

using detail::Field;
using detail::RowError;

constexpr double kNull = 1e30;

class Reader {
 public:
  explicit Reader(const SticksOptions& options) : collector_(options) {}

  void add_row(std::int64_t number, std::string_view row) {
    const std::string_view content = text::trimmed(row);
    if (content.empty()) return;
    if (content.starts_with("->")) return start_line(text::trimmed(content.substr(2)));
    if (content.starts_with("FSASCI")) {
      throw Error(ErrorCode::kFormat, fmt::format("line {}: the file is a CPS-3 grid, not lines", number),
                  "export the fault's lines (a file that starts with FFASCI)");
    }
    if (content.starts_with("FF") || content.starts_with("FS")) return header(content);
    if (detail::is_comment(row)) return collector_.skip();
    try {
      detail::split_fields(row, 0, fields_);
      add(row);
    } catch (const RowError& error) {
      collector_.reject(number, error);
    }
  }

  SticksImport finish() {
    if (stick_ == 0 && collector_.read() > 0) {
      collector_.assume("no row starts with '->': all rows are one line");
    }
    return collector_.finish("a point of a line", "rows read: '->' in front of each line, and x y z");
  }

 private:
  void start_line(std::string_view name) {
    const bool is_name = !name.empty() && !text::number(name);
    fault_ = is_name ? name : std::string_view{};
    if (is_name) collector_.assume("the text after '->' names the fault");
    stick_ = ++lines_;
  }

  void header(std::string_view content) {
    collector_.skip();
    detail::split_fields(content, 0, fields_);
    const std::string_view last = fields_.back().text;
    if (!content.starts_with("FFASCI") || last.find_first_of(".eE") == std::string_view::npos) return;
    if (const auto value = text::number(last)) null_ = *value;
  }

  void add(std::string_view row) {
    constexpr std::string_view kNames[] = {"X coordinate", "Y coordinate", "z"};
    double values[3];
    for (std::size_t n = 0; n < 3; ++n) {
      const Field& field = detail::field_at(fields_, n, row, kNames[n]);
      values[n] = detail::number_of(field, kNames[n]);
      if (null_ && values[n] == *null_) {
        throw RowError{field.at, fmt::format("the {} is the file's null value", kNames[n])};
      }
    }
    collector_.add({.name = fault_, .stick = stick_, .xy = {{values[0], values[1]}}, .z = values[2]});
  }

  detail::StickCollector collector_;
  std::vector<Field> fields_;
  std::optional<double> null_;
  std::string_view fault_;  // in the text that is read
  std::int64_t lines_ = 0;
  std::int64_t stick_ = 0;
};

}  // namespace

bool recognises(std::string_view head) {
  detail::Rows rows(head);
  bool found = false;
  while (rows.next()) {
    const std::string_view row = text::trimmed(rows.row());
    if (row.starts_with("FSASCI")) return false;
    found = found || row.starts_with("FFASCI") || row.starts_with("->");
  }
  return found;
}

SticksImport parse(std::string_view text, const SticksOptions& options) {
  return detail::read_rows(Reader(options), text);
}

std::string write(std::span<const Stick> sticks, const SticksWriteOptions& options,
                  std::vector<std::string>& /*renamed*/) {
  const int decimals = z_decimals(options.vertical_unit);
  std::string out = fmt::format("FFASCI 0 {:.1E}\nFFATTR X Y Z\n", kNull);
  for (const Stick& stick : sticks) {
    out += "->\n";
    for (const survey::WorldPoint& point : stick.points) {
      fmt::format_to(std::back_inserter(out), "{:.4f} {:.4f} {:.{}f}\n", point.x, point.y,
                     options.z_positive_up ? -point.z : point.z, decimals);
    }
  }
  return out;
}

}  // namespace footwall::formats::cps3
