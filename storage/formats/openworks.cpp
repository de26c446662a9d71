#include "storage/formats/openworks.h"

#include <fmt/format.h>
#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "storage/base/error.h"
#include "storage/base/text.h"
#include "storage/formats/detail/stick_collector.h"

namespace footwall::formats::openworks {
namespace {

using detail::Field;
using detail::RowError;

constexpr std::string_view kPlane = "New Fault Plane, version";
constexpr std::size_t kNameColumns = 60;
constexpr std::size_t kDomainFrom = 117;    // after name, interpreter (5), survey (40) and a word (12)
constexpr std::size_t kPointsFrom = 20;     // after the interpreter (5) and blanks (15)
constexpr std::size_t kMostMiscounts = 20;  // told

// Bytes of the first `count` characters, where a character is what UTF-8 takes for one.
std::size_t bytes_of(std::string_view row, std::size_t count) {
  std::size_t at = 0;
  for (std::size_t n = 0; at < row.size(); ++at) {
    const bool starts = (static_cast<unsigned char>(row[at]) & 0xC0) != 0x80;
    if (starts && n++ == count) break;
  }
  return at;
}

class Reader {
 public:
  explicit Reader(const SticksOptions& options) : collector_(options), options_(options) {}

  void add_row(std::int64_t number, std::string_view row) {
    const std::string_view content = text::trimmed(row);
    if (content.empty()) return;
    if (content.starts_with(kPlane)) {
      end_segment();
      collector_.skip();
      next_ = Next::kPlaneRow;
    } else if (next_ == Next::kPlaneRow) {
      plane(row);
    } else if (content.starts_with("Fault Segment")) {
      end_segment();
      collector_.skip();
      next_ = Next::kPointsStated;
      segment_row_ = number;
    } else if (next_ == Next::kPointsStated) {
      const auto words = text::words(row.substr(std::min(kPointsFrom, row.size())));
      points_stated_ = words.empty() ? std::nullopt : text::integer(words[0]);
      collector_.skip();
      next_ = Next::kDomainRow;
    } else {
      point(number, row, content);
    }
  }

  SticksImport finish() {
    end_segment();
    return collector_.finish("a point of a fault plane",
                             "rows read: 'New Fault Plane, version ...', then 'Fault Segment' and x y z");
  }

 private:
  enum class Next : std::uint8_t { kPlaneRow, kPointsStated, kDomainRow, kPoints };

  void plane(std::string_view row) {
    collector_.skip();
    next_ = Next::kPoints;
    name_ = text::trimmed(row.substr(0, bytes_of(row, kNameColumns)));
    const auto words = text::words(row.substr(bytes_of(row, kDomainFrom)));
    const std::string_view domain = words.empty() ? std::string_view{} : words[0];
    const bool is_time = domain.starts_with("TIME");
    if (!is_time && !domain.starts_with("DEPTH")) return;
    const std::string& survey = options_.vertical_unit;
    if (options_.z_unit.empty() && !survey.empty() && (survey == "ms") != is_time) {
      throw Error(
          ErrorCode::kInvalid,
          fmt::format("the file says that z of '{}' is {}, and the survey's is in {}", name_,
                      is_time ? "time" : "depth", survey),
          "where the file is wrong, --z-unit tells the unit; between time and depth nothing is converted");
    }
    collector_.assume(
        fmt::format("z is {}, as the file says, which does not name the unit", is_time ? "time" : "depth"));
  }

  void point(std::int64_t number, std::string_view row, std::string_view content) {
    const bool domain = content.starts_with("TIME") || content.starts_with("DEPTH");
    if (next_ == Next::kDomainRow && domain) {
      next_ = Next::kPoints;
      return collector_.skip();
    }
    next_ = Next::kPoints;
    ++points_;
    try {
      if (segment_row_ == 0) throw RowError{0, "the row does not belong to a Fault Segment"};
      detail::split_fields(row, 0, fields_);
      constexpr std::string_view kNames[] = {"X coordinate", "Y coordinate", "z"};
      double values[3];
      for (std::size_t n = 0; n < 3; ++n) {
        values[n] = detail::number_of(detail::field_at(fields_, n, row, kNames[n]), kNames[n]);
      }
      if (number_ == 0) number_ = ++sticks_of_[std::string(name_)];
      collector_.add({.name = name_, .stick = number_, .xy = {{values[0], values[1]}}, .z = values[2]});
    } catch (const RowError& error) {
      collector_.reject(number, error);
    }
  }

  void end_segment() {
    if (segment_row_ > 0 && points_stated_ && *points_stated_ != points_ && miscounts_++ < kMostMiscounts) {
      collector_.assume(fmt::format("line {}: the segment states {} points and has {} rows", segment_row_,
                                    *points_stated_, points_));
    }
    points_stated_.reset();
    points_ = 0;
    number_ = 0;
    segment_row_ = 0;
  }

  detail::StickCollector collector_;
  const SticksOptions& options_;
  std::vector<Field> fields_;
  Next next_ = Next::kPoints;
  std::string_view name_;  // in the text that is read
  std::map<std::string, std::int64_t> sticks_of_;
  std::int64_t number_ = 0;       // of the segment's stick; 0: it has none yet
  std::int64_t segment_row_ = 0;  // 0: outside of segments
  std::optional<std::int64_t> points_stated_;
  std::int64_t points_ = 0;
  std::size_t miscounts_ = 0;
};

}  // namespace

bool recognises(std::string_view head) {
  detail::Rows rows(head);
  while (rows.next()) {
    if (text::trimmed(rows.row()).starts_with(kPlane)) return true;
  }
  return false;
}

SticksImport parse(std::string_view text, const SticksOptions& options) {
  return detail::read_rows(Reader(options), text);
}

}  // namespace footwall::formats::openworks
