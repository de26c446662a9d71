#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <unordered_map>

#include "storage/base/error.h"
#include "storage/base/partial_file.h"
#include "storage/base/text.h"
#include "storage/formats/detail/letters.h"
#include "storage/formats/detail/utf8.h"
#include "storage/formats/gocad_tsurf.h"
#include "storage/formats/z_unit.h"

namespace footwall::formats::gocad_tsurf {
namespace {

// The first words of a row, found without an allocation; what stands behind them is not looked at.
struct Row {
  std::string_view line;
  std::array<std::string_view, 5> words{};
  std::size_t count = 0;

  explicit Row(std::string_view text) : line(text) {
    constexpr std::string_view kBlank = " \t\r\v\f";
    std::size_t at = 0;
    while (count < words.size() && (at = line.find_first_not_of(kBlank, at)) != std::string_view::npos) {
      const std::size_t end = std::min(line.find_first_of(kBlank, at), line.size());
      words[count++] = line.substr(at, end - at);
      at = end;
    }
  }
  std::string_view operator[](std::size_t n) const { return n < count ? words[n] : std::string_view{}; }
  // From 1; of a word that is missing: one behind the line's end.
  std::int64_t column(std::size_t n) const {
    return n < count ? words[n].data() - line.data() + 1 : static_cast<std::int64_t>(line.size()) + 1;
  }
};

// Which vertex an id means. Ids mostly run from 0 or 1 without gaps: an array holds these, a map the others.
class VertexIds {
 public:
  struct Entry {
    std::int32_t vertex = -1;
    std::int32_t part = -1;  // the TFACE that defined it
  };
  Entry find(std::int64_t id) const {
    if (id >= 0 && static_cast<std::size_t>(id) < dense_.size()) {
      const Entry& entry = dense_[static_cast<std::size_t>(id)];
      if (entry.vertex >= 0) return entry;
    }
    const auto found = sparse_.find(id);
    return found == sparse_.end() ? Entry{} : found->second;
  }
  // `known`: how many vertices there are. A later definition of an id hides the earlier one.
  void put(std::int64_t id, Entry entry, std::size_t known) {
    const auto limit = static_cast<std::int64_t>(2 * known + 1024);
    if (id < 0 || id >= limit) {
      sparse_[id] = entry;
      return;
    }
    if (static_cast<std::size_t>(id) >= dense_.size()) dense_.resize(static_cast<std::size_t>(id) + 1);
    dense_[static_cast<std::size_t>(id)] = entry;
  }
  void clear() {
    dense_.clear();
    sparse_.clear();
  }

 private:
  std::vector<Entry> dense_;
  std::unordered_map<std::int64_t, Entry> sparse_;
};

// The part of a keyed row behind its colon, "name: F 1" -> "F 1"; nothing where the key is another one.
std::optional<std::string_view> value_of(std::string_view content, std::string_view key) {
  if (!content.starts_with(key)) return std::nullopt;
  content = text::trimmed(content.substr(key.size()));
  if (!content.starts_with(':')) return std::nullopt;
  return text::trimmed(content.substr(1));
}

// Words, where quotation marks hold blanks together: AXIS_UNIT "m" "m" "".
std::vector<std::string_view> quoted_words(std::string_view line) {
  std::vector<std::string_view> found;
  while (!(line = text::trimmed(line)).empty()) {
    const bool quoted = line.front() == '"';
    if (quoted) line.remove_prefix(1);
    const std::size_t end = std::min(quoted ? line.find('"') : line.find_first_of(" \t"), line.size());
    found.push_back(line.substr(0, end));
    line.remove_prefix(std::min(end + 1, line.size()));
  }
  return found;
}

// One "GOCAD TSurf ... END" after the other.
class Parser {
 public:
  explicit Parser(std::optional<bool> z_positive_up) : z_override_(z_positive_up) {}

  void add_line(std::int64_t number, std::string_view line) {
    line_number_ = number;
    const Row row(line);
    if (row.count == 0) return;
    if (row[0] == "GOCAD" && row.count >= 2) return begin(row);
    if (!inside_ || row[0].starts_with('#')) return skip();
    if (in_block_) return block(line);
    const std::string_view word = row[0];
    if (word == "VRTX" || word == "PVRTX") return vertex(row);
    if (word == "TRGL") return triangle(row);
    if (word == "ATOM" || word == "PATOM") return atom(row);
    skip();
    if (word == "END") return end();
    if (word == "TFACE") {
      ++part_;
    } else if (word.starts_with("HEADER") || word.find("_HEADER") != std::string_view::npos) {
      in_block_ = true;
      in_header_ = word.starts_with("HEADER");
      const std::size_t brace = line.find('{');
      if (brace != std::string_view::npos) block(line.substr(brace + 1), false);
    } else if (word == "ZPOSITIVE") {
      z_positive(row);
    } else if (word == "AXIS_UNIT") {
      axis_units(line);
    } else if (word == "PROPERTIES") {
      for (const std::string_view name : quoted_words(line.substr(line.find(word) + word.size())))
        object_.properties.push_back(detail::as_utf8(name));
    }
  }

  ReadResult finish() {
    if (inside_) {
      result_.report.assumed.push_back(fmt::format("{} is whole: it has no END", named()));
      end();
    }
    if (result_.objects.empty()) {
      throw Error(ErrorCode::kFormat, "there is no TSurf with triangles",
                  result_.report.rejected.empty()
                      ? "the file should start with 'GOCAD TSurf 1'"
                      : fmt::format("line {}: {}", result_.report.rejected[0].line,
                                    result_.report.rejected[0].reason));
    }
    return std::move(result_);
  }

 private:
  void skip() { ++result_.report.skipped; }

  template <std::invocable Reason>
  void reject(std::int64_t column, const Reason& reason) {
    ImportReport& report = result_.report;
    ++report.rejected_count;
    if (report.rejected.size() < ImportReport::kListedRejects)
      report.rejected.push_back({line_number_, column, reason()});
  }
  void reject(std::int64_t column, std::string_view reason) {
    reject(column, [&] { return std::string(reason); });
  }

  std::string named() const {
    return object_.surface.name.empty() ? "the surface" : "surface " + object_.surface.name;
  }

  void begin(const Row& row) {
    if (inside_) {
      result_.report.assumed.push_back(
          fmt::format("{} is whole: a new object starts before its END", named()));
      end();
    }
    inside_ = row[1] == "TSurf" || row[1] == "TSURF" || row[1] == "tsurf";
    in_block_ = in_header_ = false;
    part_ = 0;
    object_ = {};
    ids_.clear();
    skip();
    if (!inside_) {
      reject(row.column(1),
             [&] { return fmt::format("a {} object is no TSurf and is left out", detail::as_utf8(row[1])); });
    }
  }

  // The rows of "HEADER {" ... "}" or "PROPERTY_CLASS_HEADER z {" ... "}".
  void block(std::string_view line, bool count = true) {
    if (count) skip();
    std::string_view content = text::trimmed(line);
    if (content.starts_with('{')) content = text::trimmed(content.substr(1));
    // "name:F1 }" ends the block, the name "F {1}" does not.
    const bool ends = content.ends_with('}') && std::count(content.begin(), content.end(), '}') >
                                                    std::count(content.begin(), content.end(), '{');
    if (ends) content = text::trimmed(content.substr(0, content.size() - 1));
    if (content.starts_with('*')) content.remove_prefix(1);
    if (const auto name = value_of(content, "name"); in_header_ && name)
      object_.surface.name = detail::as_utf8(*name);
    if (ends) in_block_ = in_header_ = false;
  }

  void z_positive(const Row& row) {
    std::string word = detail::lower(row[1]);
    std::erase(word, '"');
    if (word == "depth" || word == "down") {
      object_.z_positive_up = false;
    } else if (word == "elevation" || word == "up") {
      object_.z_positive_up = true;
    } else {
      reject(row.column(1), "ZPOSITIVE is neither Elevation nor Depth");
    }
  }

  void axis_units(std::string_view line) {
    const auto words = quoted_words(line);  // AXIS_UNIT x y z
    const auto unit = [&](std::size_t n) {
      return n < words.size() ? z_unit_from(words[n]).value_or("") : std::string_view{};
    };
    if (unit(1) == unit(2)) object_.horizontal_unit = unit(1);
    object_.vertical_unit = unit(3);
    for (std::size_t n = 1; n < 4; ++n) {
      const bool blank = n >= words.size() || text::trimmed(words[n]).empty();
      if (blank || !unit(n).empty()) continue;
      const std::int64_t column = words[n].data() - line.data() + 1;
      reject(column, [&] { return fmt::format("the unit '{}' is not known", detail::as_utf8(words[n])); });
    }
  }

  void set_vertex(const Row& row, std::int64_t id, const survey::WorldPoint& position) {
    std::vector<survey::WorldPoint>& vertices = object_.surface.vertices;
    if (vertices.size() >= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
      throw Error(ErrorCode::kMemory, fmt::format("{} has too many vertices", named()));
    }
    // A later TFACE may number its vertices anew; its triangles mean the newest.
    if (const auto known = ids_.find(id); known.vertex >= 0 && known.part == part_)
      return reject(row.column(1), [&] { return fmt::format("vertex {} is there already", id); });
    ids_.put(id, {static_cast<std::int32_t>(vertices.size()), part_}, vertices.size());
    vertices.push_back(position);
    ++result_.report.read;
  }

  void vertex(const Row& row) {
    const auto id = text::integer(row[1]);
    if (!id) return reject(row.column(1), "the vertex has no id");
    std::array<double, 3> xyz{};
    for (std::size_t n = 0; n < 3; ++n) {
      const auto number = text::number(row[n + 2]);
      if (!number || !std::isfinite(*number))
        return reject(row.column(n + 2), "the vertex has no three numbers behind its id");
      xyz[n] = *number;
    }
    set_vertex(row, *id, {xyz[0], xyz[1], xyz[2]});
  }

  // A node of its own at the position of another one, told by id: parts that touch there stay parts.
  void atom(const Row& row) {
    const auto id = text::integer(row[1]);
    const auto reference = text::integer(row[2]);
    if (!id || !reference) return reject(row.column(id ? 2 : 1), "the ATOM has no two ids");
    const VertexIds::Entry found = ids_.find(*reference);
    if (found.vertex < 0) {
      return reject(row.column(2), [&] {
        return fmt::format("ATOM {} names vertex {}, which is not there", *id, *reference);
      });
    }
    const survey::WorldPoint position = object_.surface.vertices[static_cast<std::size_t>(found.vertex)];
    set_vertex(row, *id, position);
  }

  void triangle(const Row& row) {
    std::array<std::int32_t, 3> corners{};
    for (std::size_t n = 0; n < 3; ++n) {
      const auto id = text::integer(row[n + 1]);
      if (!id) return reject(row.column(n + 1), "the triangle has no three ids");
      corners[n] = ids_.find(*id).vertex;
      if (corners[n] < 0) {
        return reject(row.column(n + 1),
                      [&] { return fmt::format("the triangle names vertex {}, which is not there", *id); });
      }
    }
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
      return reject(row.column(1), "the triangle names a vertex twice");
    object_.surface.triangles.push_back(corners);
    ++result_.report.read;
  }

  void end() {
    inside_ = in_block_ = in_header_ = false;
    survey::Surface& surface = object_.surface;
    if (surface.triangles.empty()) {
      return reject(1, [&] { return fmt::format("{} has no triangles and is left out", named()); });
    }
    if (!z_override_ && !object_.z_positive_up) {
      result_.report.assumed.push_back(fmt::format("z of {} is elevation: it has no ZPOSITIVE", named()));
    }
    if (z_override_.value_or(object_.z_positive_up.value_or(true))) {
      for (survey::WorldPoint& p : surface.vertices) p.z = 0.0 - p.z;  // no negative zeros
    }
    result_.objects.push_back(std::move(object_));
    object_ = {};
  }

  std::optional<bool> z_override_;
  ReadResult result_;
  Object object_;
  VertexIds ids_;
  std::int64_t line_number_ = 0;
  std::int32_t part_ = 0;  // which TFACE
  bool inside_ = false;
  bool in_block_ = false;
  bool in_header_ = false;
};

}  // namespace

ReadResult parse(std::string_view text, std::optional<bool> z_positive_up) {
  Parser parser(z_positive_up);
  std::int64_t number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    parser.add_line(++number, text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return parser.finish();
}

ReadResult read(const std::filesystem::path& path, std::optional<bool> z_positive_up) {
  if (!std::filesystem::exists(path)) {
    throw Error(ErrorCode::kNotFound, fmt::format("there is no file {}", path.string()));
  }
  try {
    return parse(read_whole_file(path, std::size_t{2} << 30), z_positive_up);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kFormat) throw;
    throw Error(error.code(), fmt::format("{}: {}", path.string(), error.message()), error.hint());
  }
}

}  // namespace footwall::formats::gocad_tsurf
