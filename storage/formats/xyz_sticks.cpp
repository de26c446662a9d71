#include "storage/formats/xyz_sticks.h"

#include <fmt/format.h>
#include <algorithm>

#include <iterator>

#include "storage/base/text.h"
#include "storage/formats/detail/point_table.h"
#include "storage/formats/detail/stick_collector.h"
#include "storage/formats/z_unit.h"

namespace footwall::formats::xyz_sticks {
namespace {

// Most rows are `least` to `most` numbers, with a delimiter that they share.
bool are_numbers(std::span<const std::string_view> rows, std::size_t least, std::size_t most) {
  const char delimiter = detail::delimiter_of(rows);
  std::vector<detail::Field> fields;
  return detail::mostly(rows, [&](std::string_view row) {
    detail::split_fields(row, delimiter, fields);
    const std::size_t numbers = detail::leading_numbers(row, delimiter);
    return numbers == fields.size() && numbers >= least && numbers <= most;
  });
}

char delimiter_below_headings(std::string_view text) {
  std::vector<std::string_view> rows = detail::first_rows(text);
  if (rows.size() > 1) rows.erase(rows.begin());
  return detail::delimiter_of(rows);
}

std::string write_rows(std::span<const Stick> sticks, const SticksWriteOptions& options, bool numbered) {
  std::string out;
  std::int64_t number = 0;
  const int decimals = z_decimals(options.vertical_unit);
  for (const Stick& stick : sticks) {
    if (++number > 1 && !numbered) out += '\n';
    for (const survey::WorldPoint& point : stick.points) {
      fmt::format_to(std::back_inserter(out), "{:.4f} {:.4f} {:.{}f}", point.x, point.y,
                     detail::written_z(point.z, options), decimals);
      if (numbered) fmt::format_to(std::back_inserter(out), " {}", number);
      out += '\n';
    }
  }
  return out;
}

}  // namespace

bool recognises_groups(std::string_view head) {
  if (!are_numbers(detail::first_rows(head), 3, 3)) return false;
  bool knot_before = false, blank_after = false;
  for (detail::Rows rows(head); rows.next();) {
    const std::string_view row = text::trimmed(rows.row());
    if (row.empty()) {
      blank_after = knot_before;
    } else if (!detail::is_comment(row)) {
      if (blank_after) return true;
      knot_before = true;
    }
  }
  return false;
}

bool recognises(std::string_view head) {
  const std::vector<std::string_view> rows = detail::first_rows(head);
  return are_numbers(rows, 3, 5);
}

SticksImport parse(std::string_view text, const SticksOptions& options) {
  return detail::parse_point_table(text, {false, delimiter_below_headings(text)}, options,
                                   "a point of a fault stick", "rows read: x y z [stick [node]]");
}

SticksImport parse_groups(std::string_view text, const SticksOptions& options) {
  return detail::parse_point_table(text, {false, delimiter_below_headings(text), true}, options,
                                   "a point of a fault stick",
                                   "rows read: x y z, a blank line between sticks");
}

std::string write(std::span<const Stick> sticks, const SticksWriteOptions& options,
                  std::vector<std::string>& /*renamed*/) {
  return write_rows(sticks, options, true);
}

std::string write_groups(std::span<const Stick> sticks, const SticksWriteOptions& options,
                         std::vector<std::string>& /*renamed*/) {
  return write_rows(sticks, options, false);
}

}  // namespace footwall::formats::xyz_sticks
