#include "storage/formats/pline.h"

#include <fmt/format.h>
#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "storage/base/error.h"
#include "storage/base/text.h"
#include "storage/formats/detail/line_chains.h"
#include "storage/formats/detail/stick_collector.h"
#include "storage/formats/z_unit.h"

namespace footwall::formats::pline {
namespace {

using detail::Field;
using detail::RowError;

constexpr std::string_view kRowsRead = "rows read: GOCAD PLine 1, ILINE, VRTX id x y z, SEG id id, END";

constexpr std::size_t kMostVertices = 10'000'000;  // in one object; segments likewise

enum class Kind : std::uint8_t { kNone, kPLine, kVSet, kOther };

struct Vertex {
  double x, y, z;
  std::int64_t row;
};

class Reader {
 public:
  explicit Reader(const SticksOptions& options) : collector_(options) {}

  void add_row(std::int64_t number, std::string_view row) {
    row_ = number;
    detail::split_fields(row, 0, fields_);
    if (fields_.empty()) return;
    const std::string_view word = fields_[0].text;
    if (word.starts_with('#')) return collector_.skip();
    if (word == "GOCAD" && fields_.size() > 1) return begin(fields_[1].text);
    if (kind_ == Kind::kNone || kind_ == Kind::kOther) return;
    if (in_block_ || word.starts_with("HEADER") || row.find('{') != std::string_view::npos) {
      return block(row);
    }
    try {
      keyword(word, row);
    } catch (const RowError& error) {
      collector_.reject(number, error);
    }
  }

  SticksImport finish() {
    if (kind_ == Kind::kPLine || kind_ == Kind::kVSet) {
      collector_.assume(fmt::format("object {} has no END and ends with the file", name_));
      end();
    }
    if (collector_.read() == 0 && !others_.empty()) {
      throw Error(ErrorCode::kFormat,
                  fmt::format("the file holds GOCAD {} and no PLine", fmt::join(others_, ", ")),
                  "footwall import surface reads TSurf");
    }
    SticksImport result = collector_.finish("part of a GOCAD polyline", kRowsRead);
    for (const std::string& kind : others_) {
      result.notices.push_back(fmt::format("GOCAD {} objects are left out", kind));
    }
    return result;
  }

 private:
  void begin(std::string_view kind) {
    if (kind_ == Kind::kPLine || kind_ == Kind::kVSet) {
      collector_.assume(fmt::format("object {} has no END and ends where the next one starts", name_));
      end();
    }
    kind_ = kind == "PLine" ? Kind::kPLine : kind == "VSet" ? Kind::kVSet : Kind::kOther;
    if (kind_ == Kind::kOther && others_.size() < 10 &&
        std::find(others_.begin(), others_.end(), kind) == others_.end()) {
      others_.emplace_back(kind.substr(0, 40));
    }
    name_.clear();
    z_up_.reset();
    z_unit_.clear();
    in_block_ = false;
    vertices_.clear();
    place_of_id_.clear();
    segments_.clear();
    line_start_ = 0;
  }

  // "HEADER {" ... "name:F1" ... "}", on one row or several; the blocks of properties are passed over.
  void block(std::string_view row) {
    std::string_view content = text::trimmed(row);
    if (!in_block_) {
      in_block_ = true;
      in_header_ = content.starts_with("HEADER");
      const std::size_t brace = content.find('{');
      content = brace == std::string_view::npos ? std::string_view{} : content.substr(brace);
    }
    if (content.starts_with('{')) content = text::trimmed(content.substr(1));
    if (content.ends_with('}')) {
      in_block_ = false;
      content = text::trimmed(content.substr(0, content.size() - 1));
    }
    if (!in_header_) return;
    if (content.starts_with('*')) content.remove_prefix(1);
    if (content.starts_with("name:") || content.starts_with("name :")) {
      name_ = text::trimmed(content.substr(content.find(':') + 1));
    }
  }

  void keyword(std::string_view word, std::string_view row) {
    if (word == "VRTX" || word == "PVRTX") {
      vertex(row);
    } else if (word == "ATOM" || word == "PATOM") {
      const std::int64_t id = detail::integer_of(field(1, row, "id"), "id");
      Vertex same = vertices_[place_of(2, row)];
      same.row = row_;
      set(id, same);
    } else if (word == "SEG") {
      if (segments_.size() == kMostVertices) refuse_size();
      segments_.push_back({place_of(1, row), place_of(2, row)});
      if (segments_.back().a == segments_.back().b) {
        segments_.pop_back();
        throw RowError{fields_[2].at, "the segment joins a point with itself"};
      }
    } else if (word == "ILINE") {
      end_line();
    } else if (word == "END") {
      end();
    } else if (word == "ZPOSITIVE") {
      direction(field(1, row, "direction of z"));
    } else if (word == "AXIS_UNIT") {
      const std::string_view unit = field(3, row, "unit of z").text;
      z_unit_ = z_unit_from(unit).value_or("");
      if (z_unit_.empty()) collector_.assume(fmt::format("the file's unit of z, '{}', is not known", unit));
    }
  }

  void direction(const Field& said) {
    std::string lower;
    for (const char c : said.text.substr(0, 16)) lower.push_back(c >= 'A' && c <= 'Z' ? char(c + 32) : c);
    if (lower != "depth" && lower != "elevation") {
      throw RowError{said.at, "ZPOSITIVE is neither Depth nor Elevation"};
    }
    z_up_ = lower == "elevation";
  }

  const Field& field(std::size_t n, std::string_view row, std::string_view what) const {
    return detail::field_at(fields_, n, row, what);
  }

  void vertex(std::string_view row) {
    const std::int64_t id = detail::integer_of(field(1, row, "id"), "id");
    set(id, {detail::number_of(field(2, row, "X coordinate"), "X coordinate"),
             detail::number_of(field(3, row, "Y coordinate"), "Y coordinate"),
             detail::number_of(field(4, row, "z"), "z"), row_});
  }

  // A later line may number its points anew; what follows means the newest.
  void set(std::int64_t id, const Vertex& at) {
    if (vertices_.size() == kMostVertices) refuse_size();
    place_of_id_[id] = vertices_.size();
    vertices_.push_back(at);
  }

  [[noreturn]] void refuse_size() const {
    throw Error(ErrorCode::kMemory,
                fmt::format("object {} has more than {} points or segments", name_, kMostVertices),
                "split it");
  }

  std::size_t place_of(std::size_t n, std::string_view row) const {
    const Field& id = field(n, row, "id");
    const auto found = place_of_id_.find(detail::integer_of(id, "id"));
    if (found == place_of_id_.end()) throw RowError{id.at, fmt::format("there is no point {}", id.text)};
    return found->second;
  }

  void end_line() {
    if (line_start_ == 0 && !vertices_.empty()) state_z();
    if (kind_ == Kind::kVSet) {
      for (std::size_t place = line_start_; place < vertices_.size(); ++place) add_stick({place});
    } else if (segments_.empty()) {
      std::vector<std::size_t> all(vertices_.size() - line_start_);
      for (std::size_t n = 0; n < all.size(); ++n) all[n] = line_start_ + n;
      if (all.size() > 1) collector_.assume("an ILINE without SEG joins its points in their order");
      if (!all.empty()) add_stick(all);
    } else {
      for (const auto& chain : detail::line_chains(line_start_, vertices_.size(), segments_)) {
        add_stick(chain);
      }
    }
    segments_.clear();
    line_start_ = vertices_.size();
  }

  void state_z() {
    if (z_up_) {
      collector_.file_states(z_up_, z_unit_);
    } else {
      collector_.file_states(true, z_unit_, "GOCAD's default: the file has no ZPOSITIVE");
    }
  }

  void add_stick(const std::vector<std::size_t>& places) {
    const std::int64_t number = ++sticks_of_[name_];
    for (const std::size_t place : places) {
      const Vertex& at = vertices_[place];
      try {
        collector_.add({.name = name_, .stick = number, .xy = {{at.x, at.y}}, .z = at.z});
      } catch (const RowError& error) {
        collector_.reject(at.row, error);
      }
    }
  }

  void end() {
    end_line();
    kind_ = Kind::kNone;
  }

  detail::StickCollector collector_;
  std::vector<Field> fields_;
  std::int64_t row_ = 0;
  Kind kind_ = Kind::kNone;
  std::vector<std::string> others_;  // kinds of objects that are left out
  std::string name_;
  std::optional<bool> z_up_;
  std::string z_unit_;
  bool in_block_ = false, in_header_ = false;
  std::vector<Vertex> vertices_;  // of the object
  std::unordered_map<std::int64_t, std::size_t> place_of_id_;
  std::vector<detail::Segment> segments_;  // of the line
  std::size_t line_start_ = 0;             // where the line's vertices start
  std::map<std::string, std::int64_t> sticks_of_;
};

// Two faults whose names become the same would come back as one.
std::string unused_name(std::string_view fault, const SticksWriteOptions& options,
                        std::set<std::string>& used, std::vector<std::string>& renamed) {
  const std::string name = detail::written_name(fault, "{}\n\r", options.names_without_blanks, renamed);
  std::string unused = name;
  for (int n = 2; !used.insert(unused).second; ++n) unused = fmt::format("{}_{}", name, n);
  if (unused != name) renamed.push_back(fmt::format("{} -> {}", fault, unused));
  return unused;
}

void write_stick(std::string& out, const Stick& stick, std::int64_t& id, const SticksWriteOptions& options) {
  out += "ILINE\n";
  const std::int64_t first = id;
  const int decimals = z_decimals(options.vertical_unit);
  for (const survey::WorldPoint& point : stick.points) {
    fmt::format_to(std::back_inserter(out), "VRTX {} {:.4f} {:.4f} {:.{}f}\n", id++, point.x, point.y,
                   options.z_positive_up ? -point.z : point.z, decimals);
  }
  for (std::int64_t n = first; n + 1 < id; ++n) {
    fmt::format_to(std::back_inserter(out), "SEG {} {}\n", n, n + 1);
  }
}

}  // namespace

bool recognises(std::string_view head) {
  detail::Rows rows(head);
  std::vector<Field> fields;
  while (rows.next()) {
    if (!text::trimmed(rows.row()).starts_with("GOCAD")) continue;
    detail::split_fields(rows.row(), 0, fields);
    if (fields.size() > 1 && (fields[1].text == "PLine" || fields[1].text == "VSet")) return true;
  }
  return false;
}

SticksImport parse(std::string_view text, const SticksOptions& options) {
  return detail::read_rows(Reader(options), text);
}

std::string write(std::span<const Stick> sticks, const SticksWriteOptions& options,
                  std::vector<std::string>& renamed) {
  std::vector<std::string_view> faults;  // in the order of their first stick
  std::map<std::string_view, std::vector<const Stick*>> sticks_of;
  for (const Stick& stick : sticks) {
    std::vector<const Stick*>& list = sticks_of[stick.fault];
    if (list.empty()) faults.push_back(stick.fault);
    list.push_back(&stick);
  }
  std::set<std::string> used;
  std::string out;
  for (const std::string_view fault : faults) {
    const std::string name = unused_name(fault, options, used, renamed);
    fmt::format_to(std::back_inserter(out),
                   "GOCAD PLine 1\nHEADER {{\nname:{}\n}}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\n"
                   "AXIS_NAME \"X\" \"Y\" \"Z\"\nAXIS_UNIT \"{}\" \"{}\" \"{}\"\nZPOSITIVE {}\n"
                   "END_ORIGINAL_COORDINATE_SYSTEM\n",
                   name, options.horizontal_unit, options.horizontal_unit, options.vertical_unit,
                   options.z_positive_up ? "Elevation" : "Depth");
    std::int64_t id = 1;
    for (const Stick* stick : sticks_of[fault]) write_stick(out, *stick, id, options);
    out += "END\n";
  }
  return out;
}

}  // namespace footwall::formats::pline
