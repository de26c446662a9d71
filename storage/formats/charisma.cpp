#include "storage/formats/charisma.h"

#include <fmt/format.h>
#include <algorithm>
#include <map>
#include <optional>

#include <cctype>
#include <cmath>
#include <iterator>

#include "storage/base/text.h"
#include "storage/formats/detail/stick_collector.h"
#include "storage/formats/z_unit.h"

namespace footwall::formats::charisma {
namespace {

using detail::Field;
using detail::RowError;

// Walks over one line, word by word, and remembers where it is.
class Row {
 public:
  explicit Row(std::string_view line) : line_(line) {}

  std::size_t place() {
    at_ = std::min(line_.find_first_not_of(" \t\r\v\f", at_), line_.size());
    return at_;
  }
  // Takes the word if it comes next, whatever its case.
  bool take(std::string_view word) {
    place();
    if (line_.size() - at_ < word.size()) return false;
    for (std::size_t n = 0; n < word.size(); ++n) {
      if (std::toupper(static_cast<unsigned char>(line_[at_ + n])) != word[n]) return false;
    }
    at_ += word.size();
    return true;
  }
  // "-", ":" or "=" between a marker and its number; a second "-" is the number's sign.
  void take_separator() {
    place();
    if (at_ < line_.size() && (line_[at_] == '-' || line_[at_] == ':' || line_[at_] == '=')) ++at_;
  }
  Field word(std::string_view what) {
    const std::size_t from = place();
    const std::size_t end = std::min(line_.find_first_of(" \t\r\v\f", from), line_.size());
    if (end == from) throw RowError{from, fmt::format("the row ends before the {}", what)};
    at_ = end;
    return {line_.substr(from, end - from), from};
  }
  double number(std::string_view what) { return detail::number_of(word(what), what); }
  std::string_view rest() {
    place();
    return text::trimmed(line_.substr(at_));
  }

 private:
  std::string_view line_;
  std::size_t at_ = 0;
};

std::string_view without_quotes(std::string_view name) {
  name = text::trimmed(name);
  if (name.size() >= 2 && name.front() == name.back() && (name.front() == '"' || name.front() == '\'')) {
    name = name.substr(1, name.size() - 2);
  }
  return text::trimmed(name);
}

// What follows z: the fault's name, which may have blanks, and the stick's number as the last word.
void parse_name(Row& row, bool has_crossline_marker, detail::Knot& knot) {
  const std::size_t place = row.place();
  const std::string_view rest = row.rest();
  if (rest.empty()) {
    throw RowError{place, has_crossline_marker ? "nothing follows z: a horizon, not a fault stick"
                                               : "nothing follows z: no fault name and stick number"};
  }
  const std::size_t blank = rest.find_last_of(" \t\"'");
  const std::string_view last = rest.substr(blank == std::string_view::npos ? 0 : blank + 1);
  const auto stick = text::number(last);
  if (!stick || std::floor(*stick) != *stick || std::fabs(*stick) > 1e15) {
    throw RowError{place + rest.size() - last.size(),
                   fmt::format("the row ends with '{}', not with a stick number", last)};
  }
  knot.stick = static_cast<std::int64_t>(*stick);
  knot.name = without_quotes(rest.substr(0, rest.size() - last.size()));
}

bool is_null(const Field& field) {
  const auto value = text::number(field.text);
  return value && std::fabs(*value) >= detail::kNullFrom;
}

// The row's knot; nothing for a row that does not start with INLINE.
std::optional<detail::Knot> parse_row(std::string_view line) {
  Row row(line);
  row.take("\"");  // a quoted first word
  if (!row.take("INLINE")) return std::nullopt;
  row.take_separator();
  row.take("\"");
  detail::Knot knot;
  const double inline_number = row.number("inline number");
  const bool has_crossline_marker = row.take("XLINE") || row.take("CROSSLINE");
  if (has_crossline_marker) row.take_separator();
  knot.lines = {{inline_number, row.number("crossline number")}};
  const Field x = row.word("X coordinate");
  const Field y = row.word("Y coordinate");
  const bool placed_by_lines = is_null(x) && is_null(y);
  knot.xy = {{placed_by_lines ? 0 : detail::number_of(x, "X coordinate"),
              placed_by_lines ? 0 : detail::number_of(y, "Y coordinate")}};
  knot.z = row.number("z");
  parse_name(row, has_crossline_marker, knot);
  return knot;
}

bool starts_with_inline_number(std::string_view line) {
  Row row(line);
  row.take("\"");
  if (!row.take("INLINE")) return false;
  row.take_separator();
  row.take("\"");
  const std::string_view rest = row.rest();
  return text::number(rest.substr(0, rest.find_first_of(" \t"))).has_value();
}

// Words before the first knot: no marker, or headings such as "INLINE CROSSLINE X Y Z".
bool is_header(std::string_view content) {
  if (starts_with_inline_number(content)) return false;
  std::vector<Field> words;
  detail::split_fields(content, 0, words);
  const auto is_number = [](const Field& word) { return text::number(word.text).has_value(); };
  return Row(content).take("INLINE") ? std::none_of(words.begin(), words.end(), is_number)
                                     : !is_number(words.front());
}

}  // namespace

bool recognises(std::string_view head) {
  const auto rows = detail::first_rows(head);
  return std::any_of(rows.begin(), rows.end(), starts_with_inline_number);
}

SticksImport parse(std::string_view text, const SticksOptions& options) {
  detail::StickCollector sticks(options);
  for (detail::Rows rows(text); rows.next();) {
    const std::string_view line = rows.row();
    const std::string_view content = text::trimmed(line);
    if (content.empty()) continue;
    if (detail::is_comment(content)) {
      sticks.skip();
      continue;
    }
    try {
      if (sticks.read() == 0 && rows.number() <= detail::kMostHeaderRows && is_header(content)) {
        sticks.skip();
      } else if (const auto knot = parse_row(line)) {
        sticks.add(*knot);
      } else {
        throw RowError{line.find_first_not_of(" \t"), "the row does not start with INLINE"};
      }
    } catch (const RowError& why) {
      sticks.reject(rows.number(), why);
    }
  }
  return sticks.finish("a Charisma fault stick",
                       "rows read: INLINE- inline crossline x y z fault-name stick-number");
}

std::string write(std::span<const Stick> sticks, const SticksWriteOptions& options,
                  std::vector<std::string>& renamed) {
  std::string out;
  std::map<std::string_view, std::int64_t> count;
  for (const Stick& stick : sticks) {
    const std::int64_t number = ++count[stick.fault];
    std::string name = detail::written_name(stick.fault, "", options.names_without_blanks, renamed);
    if (without_quotes(name) != name)
      name = detail::written_name(stick.fault, "\"'", options.names_without_blanks, renamed);
    for (const survey::WorldPoint& point : stick.points) {
      const auto [inline_number, crossline_number] = detail::nearest_lines(point, options);
      fmt::format_to(std::back_inserter(out), "INLINE- {:>7} {:>7} {:>16.4f} {:>16.4f} {:>12.{}f} {} {}\n",
                     inline_number, crossline_number, point.x, point.y, detail::written_z(point.z, options),
                     z_decimals(options.vertical_unit), name, number);
    }
  }
  return out;
}

}  // namespace footwall::formats::charisma
