#include "storage/formats/charisma.h"

#include <fmt/format.h>
#include <algorithm>

#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "storage/base/error.h"
#include "storage/base/partial_file.h"
#include "storage/base/text.h"
#include "storage/formats/detail/utf8.h"

namespace footwall::formats::charisma {
namespace {

constexpr double kNullFrom = 1e29;  // 1e30 and its kin stand for "no value"

struct Rejected {
  std::size_t at;  // in the line
  std::string reason;
};

// Walks over one line, word by word, and remembers where it is.
class Row {
 public:
  explicit Row(std::string_view line) : line_(line) {}

  void skip_blanks() { at_ = std::min(line_.find_first_not_of(" \t\r\v\f", at_), line_.size()); }
  bool at_end() {
    skip_blanks();
    return at_ == line_.size();
  }
  std::size_t place() {
    skip_blanks();
    return at_;
  }
  // Takes the word if it comes next, whatever its case.
  bool take(std::string_view word) {
    skip_blanks();
    if (line_.size() - at_ < word.size()) return false;
    for (std::size_t n = 0; n < word.size(); ++n) {
      if (std::toupper(static_cast<unsigned char>(line_[at_ + n])) != word[n]) return false;
    }
    at_ += word.size();
    return true;
  }
  // "-", ":" or "=" between a marker and its number; a second "-" is the number's sign.
  void take_separator() {
    skip_blanks();
    if (at_ < line_.size() && (line_[at_] == '-' || line_[at_] == ':' || line_[at_] == '=')) ++at_;
  }
  double number(std::string_view what) {
    const std::size_t from = place();
    const std::string_view word = next_word();
    if (word.empty()) throw Rejected{from, fmt::format("the row ends before the {}", what)};
    const auto value = text::number(word);
    if (!value || !std::isfinite(*value)) throw Rejected{from, fmt::format("'{}' is no {}", word, what)};
    return *value;
  }
  std::string_view rest() {
    skip_blanks();
    return text::trimmed(line_.substr(at_));
  }

 private:
  std::string_view next_word() {
    skip_blanks();
    const std::size_t end = std::min(line_.find_first_of(" \t\r\v\f", at_), line_.size());
    const std::string_view word = line_.substr(at_, end - at_);
    at_ = end;
    return word;
  }
  std::string_view line_;
  std::size_t at_ = 0;
};

struct Knot {
  std::string name;  // "" where the row has none
  std::string name_in_file;
  std::int64_t stick = 0;
  survey::WorldPoint point;
  bool without_lines = false;
};

bool is_comment(std::string_view line) {
  return line.front() == '#' || line.front() == '!' || line.starts_with("//") || line.starts_with("--");
}

std::string_view without_quotes(std::string_view name) {
  if (name.size() >= 2 && name.front() == name.back() && (name.front() == '"' || name.front() == '\'')) {
    name = name.substr(1, name.size() - 2);
  }
  return text::trimmed(name);
}

std::string with_single_blanks(std::string_view name) {
  std::string out;
  for (const std::string_view word : text::words(name)) {
    if (!out.empty()) out.push_back(' ');
    out += word;
  }
  return out;
}

// What follows z: the fault's name, which may have blanks, and the stick's number as the last word.
void parse_name(Row& row, bool has_crossline_marker, Knot& knot) {
  const std::size_t place = row.place();
  const std::string_view rest = row.rest();
  if (rest.empty()) {
    throw Rejected{place, has_crossline_marker ? "nothing follows z: a horizon, not a fault stick"
                                               : "nothing follows z: no fault name and stick number"};
  }
  const std::size_t blank = rest.find_last_of(" \t\"'");
  const std::string_view last = rest.substr(blank == std::string_view::npos ? 0 : blank + 1);
  const auto stick = text::number(last);
  if (!stick || std::floor(*stick) != *stick || std::fabs(*stick) > 1e15) {
    throw Rejected{place + rest.size() - last.size(),
                   fmt::format("the row ends with '{}', not with a stick number", last)};
  }
  knot.stick = static_cast<std::int64_t>(*stick);
  knot.name_in_file = without_quotes(text::trimmed(rest.substr(0, rest.size() - last.size())));
  knot.name = with_single_blanks(detail::as_utf8(knot.name_in_file));
}

// The row's knot; nothing for a row that does not start with INLINE.
std::optional<Knot> parse_row(std::string_view line) {
  Row row(line);
  row.take("\"");  // a quoted first word
  if (!row.take("INLINE")) return std::nullopt;
  row.take_separator();
  row.take("\"");
  Knot knot;
  const double inline_number = row.number("inline number");
  const bool has_crossline_marker = row.take("XLINE") || row.take("CROSSLINE");
  if (has_crossline_marker) row.take_separator();
  const double crossline_number = row.number("crossline number");
  knot.without_lines = inline_number == 0 && crossline_number == 0;
  double* const coordinates[3] = {&knot.point.x, &knot.point.y, &knot.point.z};
  constexpr std::string_view kNames[3] = {"X coordinate", "Y coordinate", "z"};
  for (int n = 0; n < 3; ++n) {
    const std::size_t place = row.place();
    *coordinates[n] = row.number(kNames[n]);
    if (std::fabs(*coordinates[n]) >= kNullFrom)
      throw Rejected{place, fmt::format("the {} is a null value", kNames[n])};
  }
  parse_name(row, has_crossline_marker, knot);
  return knot;
}

class Import {
 public:
  explicit Import(const SticksOptions& options) : options_(options) {}

  void add_line(std::int64_t number, std::string_view line) {
    const std::string_view content = text::trimmed(line);
    if (content.empty()) return;
    if (is_comment(content)) {
      ++result_.report.skipped;
      return;
    }
    try {
      const auto knot = parse_row(line);
      if (knot) {
        add(*knot);
      } else if (result_.report.read == 0 && !text::number(text::words(content).front())) {
        ++result_.report.skipped;  // a header row
      } else {
        const std::size_t indent = line.find_first_not_of(" \t");
        throw Rejected{indent, "the row does not start with INLINE"};
      }
    } catch (const Rejected& rejected) {
      ++result_.report.rejected_count;
      if (result_.report.rejected.size() < ImportReport::kListedRejects) {
        result_.report.rejected.push_back(
            {number, static_cast<std::int64_t>(rejected.at) + 1, rejected.reason});
      }
    }
  }

  SticksImport finish() {
    ImportReport& report = result_.report;
    if (result_.sticks.empty()) {
      std::string why = "no row is a Charisma fault stick";
      if (!report.rejected.empty()) {
        why += fmt::format("; line {}: {}", report.rejected.front().line, report.rejected.front().reason);
      }
      throw Error(ErrorCode::kFormat, why,
                  "rows read: INLINE- inline crossline x y z fault-name stick-number");
    }
    report.assumed.emplace_back(options_.z_positive_up ? "z is positive up, as told" : "z is positive down");
    report.assumed.emplace_back("z is in the survey's vertical unit");
    if (without_lines_ > 0) {
      report.assumed.push_back(
          fmt::format("{} rows have line numbers 0 0 and are placed by X and Y alone", without_lines_));
    }
    if (unnamed_ > 0) {
      report.assumed.push_back(
          fmt::format("{} rows have no fault name and belong to '{}'", unnamed_, kUnnamed));
    }
    return std::move(result_);
  }

 private:
  static constexpr std::string_view kUnnamed = "unnamed";

  void add(Knot knot) {
    if (knot.without_lines) ++without_lines_;
    if (knot.name.empty()) {
      knot.name = kUnnamed;
      ++unnamed_;
    } else if (knot.name != knot.name_in_file && renamed_.insert(knot.name_in_file).second) {
      result_.report.renamed.push_back(
          fmt::format("{} -> {}", detail::as_utf8(knot.name_in_file), knot.name));
    }
    if (options_.z_positive_up) knot.point.z = -knot.point.z;
    const auto [place, is_new] = sticks_.try_emplace({knot.name, knot.stick}, result_.sticks.size());
    if (is_new) result_.sticks.push_back({knot.name, knot.stick, {}});
    std::vector<survey::WorldPoint>& points = result_.sticks[place->second].points;
    if (!points.empty() && points.back() == knot.point) {
      ++result_.report.skipped;
      return;
    }
    points.push_back(knot.point);
    ++result_.report.read;
  }

  SticksOptions options_;
  SticksImport result_;
  std::map<std::pair<std::string, std::int64_t>, std::size_t> sticks_;
  std::set<std::string> renamed_;
  std::int64_t without_lines_ = 0;
  std::int64_t unnamed_ = 0;
};

}  // namespace

SticksImport parse(std::string_view text, const SticksOptions& options) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  Import import(options);
  std::int64_t number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    import.add_line(++number, text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return import.finish();
}

SticksImport read(const std::filesystem::path& path, const SticksOptions& options) {
  if (!std::filesystem::exists(path)) {
    throw Error(ErrorCode::kNotFound, fmt::format("there is no file {}", path.string()));
  }
  try {
    return parse(read_whole_file(path, std::size_t{1} << 30), options);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kFormat) throw;
    throw Error(error.code(), fmt::format("{}: {}", path.string(), error.message()), error.hint());
  }
}

}  // namespace footwall::formats::charisma
