#include "storage/formats/iesx.h"

#include <fmt/format.h>
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "storage/base/error.h"
#include "storage/base/text.h"
#include "storage/formats/detail/letters.h"
#include "storage/formats/detail/stick_collector.h"
#include "storage/formats/detail/utf8.h"
#include "storage/formats/z_unit.h"

namespace footwall::formats::iesx {
namespace {

using detail::Field;
using detail::RowError;

constexpr std::int64_t kBoundary = 3;  // the TYPE of fault boundaries
constexpr std::size_t kMostHorizonsNamed = 10;

bool is_blank(std::string_view row, std::size_t at) {
  return at >= row.size() || row[at] == ' ' || row[at] == '\t';
}

bool is_digits(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

struct Profile {
  std::string name;
  std::optional<std::int64_t> type;
  std::string ifdf;  // what kind of object it is, e.g. "3d_ci7m.ifdf"
  std::string_view z_unit;
  std::optional<bool> is_boundary{};  // as its first row shows
};

// PROFILE, the name in 17 columns, TYPE and its numbers, a comment, the ifdf's name, unit of X and Y, of z.
Profile profile_of(std::string_view row) {
  constexpr std::size_t kName = 8, kType = 25;
  Profile profile;
  const bool in_columns = row.size() > kType && row.substr(kType).starts_with("TYPE");
  const std::size_t type = in_columns ? kType : row.find("TYPE", std::min(kName, row.size()));
  profile.name = text::trimmed(row.substr(std::min(kName, row.size()), type - kName));
  const auto words = text::words(row.substr(std::min(type, row.size())));
  if (words.size() > 1) profile.type = text::integer(words[1]);
  for (std::size_t n = 0; n < words.size(); ++n) {
    if (!words[n].ends_with(".ifdf")) continue;
    profile.ifdf = words[n];
    if (n + 1 < words.size()) profile.z_unit = z_unit_from(words.back()).value_or("");
  }
  return profile;
}

bool is_profile(std::string_view row) {
  return row.starts_with("PROFILE") && row.find("TYPE", 7) != std::string_view::npos;
}

class Reader {
 public:
  explicit Reader(const SticksOptions& options) : collector_(options) {}

  void add_row(std::int64_t number, std::string_view row) {
    if (row.starts_with('\t')) return collector_.skip();
    std::size_t shift = 0;
    if (row.starts_with("EOD")) {
      shift = 3;
      row.remove_prefix(shift);
      if (text::trimmed(row).empty()) return end_profile();
    }
    if (text::trimmed(row).empty()) return;
    if (detail::is_comment(row) || row.starts_with("SNAPPING")) return collector_.skip();
    try {
      if (is_profile(row)) return begin(row);
      if (left_out_) return collector_.skip();
      if (ended_) throw RowError{0, "the row stands between EOD and the next PROFILE"};
      add(row);
    } catch (const RowError& error) {
      collector_.reject(number, {error.at + shift, error.reason});
    }
  }

  SticksImport finish() {
    if (collector_.read() == 0 && !horizons_.empty()) {
      throw Error(ErrorCode::kFormat,
                  fmt::format("the file holds horizons ({}) and no fault", fmt::join(horizons_, ", ")),
                  "export the faults; horizons are not read");
    }
    return collector_.finish("a point of a fault",
                             "rows read: PROFILE name TYPE ..., then x, y, segment and z "
                             "in columns 1-16, 17-32, 33-35 and 39-47");
  }

 private:
  void begin(std::string_view row) {
    profile_ = profile_of(row);
    ended_ = left_out_ = false;
    const std::string kind = detail::lower(profile_.ifdf);
    if (!kind.empty() && kind.find("fault") == std::string::npos) {
      left_out_ = true;
      const std::string name = detail::as_utf8(profile_.name);
      if (horizons_.size() < kMostHorizonsNamed) horizons_.push_back(name);
      throw RowError{0, fmt::format("'{}' is no fault but a horizon ({})", name, profile_.ifdf)};
    }
    if (kind.empty()) collector_.assume("profiles that do not name an ifdf are faults");
    if (!profile_.z_unit.empty()) collector_.file_states(std::nullopt, profile_.z_unit);
    collector_.skip();
  }

  void end_profile() {
    ended_ = true;
    left_out_ = false;
  }

  void add(std::string_view row) {
    if (!profile_.is_boundary) profile_.is_boundary = profile_.type == kBoundary && is_boundary(row);
    if (*profile_.is_boundary) return add_boundary(row);
    const bool wide = row.size() >= 39 && is_digits(row.substr(32, 7));
    const Field segment = wide ? detail::columns_of(row, 33, 39) : detail::columns_of(row, 33, 35);
    const std::size_t z_from = wide ? 40 : 39;
    Field z = detail::columns_of(row, z_from, 47);
    // What is too long for its columns moves all that follows; MAXFLOAT does, and stands for null.
    if (!z.text.empty() && !is_blank(row, 46) && !is_blank(row, 47)) {
      const std::string_view whole = row.substr(z.at, row.find_first_of(" \t", z.at) - z.at);
      if (std::min(whole.find('.'), whole.size()) > 12) z.text = whole;
    }
    add({detail::columns_of(row, 1, 16), detail::columns_of(row, 17, 32), segment, z});
  }

  struct Fields {
    Field x, y, segment, z;
  };

  // x and y as words before column 29, the segment in columns 29-31, apart from what stands beside it.
  bool is_boundary(std::string_view row) {
    if (row.size() < 32 || (!is_blank(row, 27) && !is_blank(row, 28)) ||
        (!is_blank(row, 30) && !is_blank(row, 31))) {
      return false;
    }
    detail::split_fields(row.substr(0, 28), 0, fields_);
    return fields_.size() == 2 && text::integer(detail::columns_of(row, 29, 31).text).has_value();
  }

  void add_boundary(std::string_view row) {
    detail::split_fields(row.substr(0, 28), 0, fields_);
    const Field& x = detail::field_at(fields_, 0, row, "X coordinate");
    const Field& y = detail::field_at(fields_, 1, row, "Y coordinate");
    const Field rest = detail::columns_of(row, 32, row.size());
    const Field z{rest.text.substr(0, rest.text.find_first_of(" \t")), rest.at};
    add({x, y, detail::columns_of(row, 29, 31), z});
  }

  void add(const Fields& fields) {
    const double x = detail::number_of(fields.x, "X coordinate");
    const double y = detail::number_of(fields.y, "Y coordinate");
    const std::int64_t segment = detail::integer_of(fields.segment, "segment number");
    const double z = detail::number_of(fields.z, "z");
    collector_.add({.name = profile_.name, .stick = segment, .xy = {{x, y}}, .z = z});
  }

  detail::StickCollector collector_;
  std::vector<Field> fields_;
  Profile profile_;
  bool left_out_ = false;  // the profile is a horizon
  bool ended_ = false;     // by EOD
  std::vector<std::string> horizons_;
};

}  // namespace

bool recognises(std::string_view head) {
  detail::Rows rows(head);
  while (rows.next()) {
    std::string_view row = rows.row();
    if (row.starts_with("EOD")) row.remove_prefix(3);
    if (is_profile(row)) return true;
  }
  return false;
}

SticksImport parse(std::string_view text, const SticksOptions& options) {
  return detail::read_rows(Reader(options), text);
}

}  // namespace footwall::formats::iesx
