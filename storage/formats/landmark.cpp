#include "storage/formats/landmark.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "storage/base/error.h"
#include "storage/base/text.h"
#include "storage/formats/detail/stick_collector.h"
#include "storage/formats/z_unit.h"

namespace footwall::formats::landmark {
namespace {

using detail::Field;
using detail::RowError;

constexpr std::size_t kLastColumn = 100000;
constexpr std::string_view kLayoutHint =
    "its rows are: FAULT_X 1 12, FAULT_Y ..., FAULT_Z ..., FAULT_PTYPE ... (first and last column, from 1)";

enum Part : std::size_t {
  kX,
  kY,
  kZ,
  kType,
  kDomain,
  kDomainUnit,
  kDistanceUnit,
  kLine,
  kTrace,
  kName,
  kParts
};
constexpr std::array<std::string_view, kParts> kKeys{"FAULT_X",
                                                     "FAULT_Y",
                                                     "FAULT_Z",
                                                     "FAULT_PTYPE",
                                                     "FAULT_DOMAIN",
                                                     "FAULT_DOMAIN_UNIT",
                                                     "FAULT_DISTANCE_UNIT",
                                                     "FAULT_LINEID",
                                                     "FAULT_TRACE",
                                                     "FAULT_NAME"};
enum PointType : std::int64_t { kStart = 1, kMiddle = 2, kEnd = 3, kControl = 4 };

struct Columns {
  std::size_t first, last;
};
using Layout = std::array<std::optional<Columns>, kParts>;

Layout layout_of(std::string_view text) {
  Layout layout;
  detail::Rows rows(text);
  std::vector<Field> fields;
  while (rows.next()) {
    detail::split_fields(rows.row(), 0, fields);
    if (fields.empty() || detail::is_comment(rows.row())) continue;
    const auto key = std::find(kKeys.begin(), kKeys.end(), fields[0].text);
    if (key == kKeys.end()) continue;
    const auto first = fields.size() > 1 ? text::integer(fields[1].text) : std::nullopt;
    const auto last = fields.size() > 2 ? text::integer(fields[2].text) : std::nullopt;
    const bool good =
        first && last && *first >= 1 && *first <= *last && *last <= static_cast<std::int64_t>(kLastColumn);
    if (!good) {
      throw Error(
          ErrorCode::kFormat,
          fmt::format("line {} of the format file does not give the columns of {}", rows.number(), *key),
          std::string(kLayoutHint));
    }
    layout[static_cast<std::size_t>(key - kKeys.begin())] =
        Columns{static_cast<std::size_t>(*first), static_cast<std::size_t>(*last)};
  }
  const bool by_xy = layout[kX] && layout[kY];
  const bool by_lines = layout[kLine] && layout[kTrace];
  std::string missing;
  if (!layout[kZ]) missing = kKeys[kZ];
  if (!layout[kType]) missing = kKeys[kType];
  if (!by_xy && !by_lines) missing = "FAULT_X and FAULT_Y, or FAULT_LINEID and FAULT_TRACE";
  if (!missing.empty()) {
    throw Error(ErrorCode::kFormat, fmt::format("the format file does not give {}", missing),
                std::string(kLayoutHint));
  }
  return layout;
}

std::string upper(std::string_view word) {
  std::string out;
  for (const char c : word) out.push_back(static_cast<char>(std::toupper(static_cast<unsigned char>(c))));
  return out;
}

class Reader {
 public:
  Reader(const SticksOptions& options, const Layout& layout) : collector_(options), layout_(layout) {}

  void add_row(std::int64_t number, std::string_view row) {
    if (text::trimmed(row).empty()) return;
    if (detail::is_comment(row)) return collector_.skip();
    try {
      add(row);
    } catch (const RowError& error) {
      collector_.reject(number, error);
    }
  }

  SticksImport finish() { return collector_.finish("a fault point in the columns given", kLayoutHint); }

 private:
  Field field(Part part, std::string_view row) const {
    return layout_[part] ? detail::columns_of(row, layout_[part]->first, layout_[part]->last) : Field{};
  }

  // The unit stands in each row, and is the same as in the row before in all but odd files.
  void state_z(std::string_view row) {
    const Field unit = field(kDomainUnit, row);
    const Field domain = field(kDomain, row);
    if (unit.text == unit_text_ && domain.text == domain_text_) return;
    std::string_view name;
    if (!unit.text.empty()) {
      const auto known = z_unit_from(unit.text);
      if (!known) throw RowError{unit.at, fmt::format("'{}' is no unit of z", unit.text)};
      name = *known;
    }
    const std::string is = upper(domain.text);
    const bool contradicts =
        (is == "TIME" && (name == "m" || name == "ft")) || (is == "DEPTH" && (name == "ms" || name == "s"));
    if (contradicts)
      throw RowError{domain.at, fmt::format("the domain is {} and the unit of z {}", is, name)};
    collector_.file_states(std::nullopt, name);
    unit_text_ = unit.text;
    domain_text_ = domain.text;
  }

  void add(std::string_view row) {
    detail::Knot knot;
    knot.name = field(kName, row).text;
    knot.stick = stick_of(row, knot.name);  // first: a start whose position is bad is a start nonetheless
    if (layout_[kX] && layout_[kY]) {
      knot.xy = {detail::number_of(field(kX, row), "X coordinate"),
                 detail::number_of(field(kY, row), "Y coordinate")};
    }
    if (layout_[kLine] && layout_[kTrace]) lines(row, knot);
    knot.z = detail::number_of(field(kZ, row), "z");
    state_z(row);
    if (const Field unit = field(kDistanceUnit, row); !unit.text.empty() && !distance_told_) {
      distance_told_ = true;
      collector_.assume(fmt::format("X and Y are in '{}', as the file says, and kept so", unit.text));
    }
    collector_.add(knot);
  }

  std::int64_t stick_of(std::string_view row, std::string_view name) {
    const Field type = field(kType, row);
    const std::int64_t point = detail::integer_of(type, "point type");
    if (point < kStart || point > kControl) {
      throw RowError{type.at, fmt::format("point type {} is not known (1 to 4 are)", point)};
    }
    std::int64_t& stick = stick_of_[std::string(name)];
    const bool starts = point == kStart || ended_ || stick == 0 || name != fault_;
    if (starts) ++stick;
    if (starts && point != kStart) {
      collector_.assume("a point that follows an end, or comes first, starts a stick whatever its type");
    }
    if (point == kControl) collector_.assume("control points (type 4) are points of their stick");
    fault_ = name;
    ended_ = point == kEnd;
    return stick;
  }

  // Beside X and Y the lines are not needed: names of 2D lines may stand there.
  void lines(std::string_view row, detail::Knot& knot) {
    if (knot.xy && (!text::number(field(kLine, row).text) || !text::number(field(kTrace, row).text))) return;
    knot.lines = {detail::number_of(field(kLine, row), "line"),
                  detail::number_of(field(kTrace, row), "trace")};
  }

  detail::StickCollector collector_;
  Layout layout_;
  std::map<std::string, std::int64_t> stick_of_;  // the last number given, by fault
  std::string_view fault_;                        // of the row before; in the text that is read
  bool ended_ = false;
  bool distance_told_ = false;
  std::string unit_text_, domain_text_;
};

}  // namespace

SticksImport parse(std::string_view text, const SticksOptions& options) {
  if (text::trimmed(options.layout).empty()) {
    throw Error(ErrorCode::kUsage, "a Landmark column file needs its format file", std::string(kLayoutHint));
  }
  return detail::read_rows(Reader(options, layout_of(options.layout)), text);
}

}  // namespace footwall::formats::landmark
