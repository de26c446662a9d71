#include "storage/formats/opendtect_sticks.h"

#include <fmt/format.h>
#include <algorithm>
#include <map>

#include <iterator>

#include "storage/formats/detail/point_table.h"
#include "storage/formats/detail/stick_collector.h"
#include "storage/formats/z_unit.h"

namespace footwall::formats::opendtect_sticks {
namespace {

bool starts_with_name(std::string_view row) {
  return row.size() > 1 && row.front() == '"' && row.find('"', 1) != std::string_view::npos;
}

std::string write_rows(std::span<const Stick> sticks, const SticksWriteOptions& options, bool bulk,
                       std::vector<std::string>& renamed) {
  std::string out;
  std::map<std::string_view, std::int64_t> count;
  const int decimals = z_decimals(options.vertical_unit);
  for (const Stick& stick : sticks) {
    const std::int64_t number = count[stick.fault]++;
    const std::string name =
        bulk ? fmt::format("\"{}\"\t", detail::written_name(stick.fault, "\"\t", false, renamed)) : "";
    std::int64_t node = 0;
    for (const survey::WorldPoint& point : stick.points) {
      fmt::format_to(std::back_inserter(out), "{}{:.4f}\t{:.4f}\t{:.{}f}\t{}\t{}\n", name, point.x, point.y,
                     detail::written_z(point.z, options), decimals, number, node++);
    }
  }
  return out;
}

}  // namespace

bool recognises(std::string_view head) {
  const std::vector<std::string_view> rows = detail::first_rows(head);
  std::vector<detail::Field> fields;
  return detail::mostly(rows, [&](std::string_view row) {
    detail::split_fields(row, '\t', fields);
    const std::size_t numbers = detail::leading_numbers(row, '\t');
    return numbers >= 3 && numbers <= 5 && fields.size() <= numbers + 1;
  });
}

bool recognises_bulk(std::string_view head) {
  const std::vector<std::string_view> rows = detail::first_rows(head);
  return detail::mostly(rows, [](std::string_view row) {
    return starts_with_name(row) && detail::leading_numbers(row, '\t', 1) >= 3;
  });
}

SticksImport parse(std::string_view text, const SticksOptions& options) {
  const std::vector<std::string_view> rows = detail::first_rows(text);
  const bool bulk = std::any_of(rows.begin(), rows.end(), starts_with_name);
  // Hand-edited files have blanks for tabs; names are quoted, so that either way their blanks do no harm.
  return detail::parse_point_table(text, {bulk, detail::delimiter_of(rows) == '\t' ? '\t' : char{0}}, options,
                                   "an OpendTect fault stick",
                                   "rows read: [\"name\"] x y z [stick [node]], tabs between");
}

std::string write(std::span<const Stick> sticks, const SticksWriteOptions& options,
                  std::vector<std::string>& renamed) {
  return write_rows(sticks, options, false, renamed);
}

std::string write_bulk(std::span<const Stick> sticks, const SticksWriteOptions& options,
                       std::vector<std::string>& renamed) {
  return write_rows(sticks, options, true, renamed);
}

}  // namespace footwall::formats::opendtect_sticks
